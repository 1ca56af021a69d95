# SPDX-License-Identifier: GPL-3.0-or-later
"""What is written beside a mesh: the order of its vertices, and its vertex groups.

A glTF file splits vertices at seams and hard edges, so it gets the index of each as the attribute
``_VERTEX``. Formats know vertex groups only as weights of bones; others are written as attributes
``_GROUP_NAME`` of glTF, or as colors of FBX. An FBX file keeps the order of vertices itself.
"""

from collections.abc import Iterator

import bpy
import numpy as np

from .. import mesh_bridge
from .targets import Target

VERTEX = "_VERTEX"
GROUP = "_GROUP_"

_LONGEST = 40  # characters of the name of a group; attributes have 63 bytes at most


def marks_of(
    target: Target, obj: bpy.types.Object, *, with_groups: bool
) -> tuple[dict[str, np.ndarray], list[str]]:
    """Return the attributes to add while an object is written.

    `obj`: an object with a mesh. `with_groups`: whether vertex groups that belong to no bone are
    written. Returns `values`: (n,) float32 for each name; `problems`: list of str.
    """
    mesh = mesh_bridge.mesh_of(obj)
    if not target.groups:
        return {}, []
    names = [group.name for group in obj.vertex_groups if group.name not in _bones(obj)]
    values = {}
    if not target.keeps_vertices:
        values[VERTEX] = np.arange(len(mesh.vertices), dtype=np.float32)
    if mesh.library is not None or not mesh.is_editable:
        lost = [] if target.keeps_vertices else [VERTEX]
        lost += names if with_groups else []
        return {}, [f'"{obj.name}" is linked: {", ".join(lost)} were not written'] if lost else []
    taken = {attribute.name.upper() for attribute in mesh.attributes}
    if VERTEX in taken:
        values.pop(VERTEX, None)
    for name in names if with_groups else []:
        values[_free(GROUP + name[:_LONGEST], taken | {key.upper() for key in values})] = (
            mesh_bridge.group_weights(obj, name).astype(np.float32)
        )
    return values, [f'"{obj.name}" keeps its own attribute {VERTEX}'] * (VERTEX in taken)


def armatures_of(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Give the armatures that pose an object."""
    for modifier in obj.modifiers:
        if isinstance(modifier, bpy.types.ArmatureModifier) and modifier.object is not None:
            yield modifier.object
    if obj.parent is not None and obj.parent.type == "ARMATURE":
        yield obj.parent


def _bones(obj: bpy.types.Object) -> set[str]:
    datas = [armature.data for armature in armatures_of(obj)]
    return {
        bone.name for data in datas if isinstance(data, bpy.types.Armature) for bone in data.bones
    }


def _free(name: str, taken: set[str]) -> str:
    """Return a name that is free in capitals too, which glTF turns all names into."""
    free, number = name, 1
    while free.upper() in taken:
        number += 1
        free = f"{name}_{number}"
    return free
