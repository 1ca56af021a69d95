# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertex groups with the names of our attributes.

To Blender, both are attributes of the same name. When Blender 5.2 leaves Edit Mode or joins meshes,
it keeps only the group and drops our attribute with the original.
"""

import itertools

import bpy

from .attributes import is_our_name, our_attributes
from .checks import is_linked


def set_groups_aside(obj: bpy.types.Object) -> None:
    """Append a number to vertex groups with the names of our attributes on the mesh.

    This is what Blender does with attributes of the same name. It also works in Edit Mode. It is
    cheap enough to be called after each update of the object.

    `obj`: an object with a mesh.
    """
    clashing = [group for group in obj.vertex_groups if is_our_name(group.name)]
    mesh = obj.data
    if not clashing or not isinstance(mesh, bpy.types.Mesh) or is_linked(mesh):
        return
    if not our_attributes(mesh):
        return
    for group in clashing:
        taken = {*obj.vertex_groups.keys(), *mesh.attributes.keys()}
        names = (f"{group.name}.{number:03}" for number in itertools.count(1))
        group.name = next(name for name in names if name not in taken)
