# SPDX-License-Identifier: GPL-3.0-or-later
"""Which vertex group the operators add to a list: that of the handles, or that of the regions."""

from collections.abc import Collection

import bpy

from ...cubic_craft_addon.handles.owner import panel_object
from ...cubic_craft_addon.mesh_bridge import vertex_group
from ...solver.errors import CubicCraftError
from .selection import poll_mesh, refuse


def poll_groups(operator_class, context, other):
    """Return whether there is a mesh with a vertex group; if not, `other` is the button to use."""
    if not poll_mesh(operator_class, context, ("OBJECT", "PAINT_WEIGHT")):
        return False
    if not panel_object(context).vertex_groups:
        return refuse(operator_class, f"The mesh has no vertex group; add one, or use {other}")
    return True


def group_to_add(obj: bpy.types.Object, name: str, taken: Collection[str], already: str) -> str:
    """Return the name of the vertex group to add.

    `name`: what was asked for; empty for the active group, or the first that is not taken. `taken`:
    collection of str, names of the groups in the list. `already`: what is true of those, for the
    message. Raises CubicCraftError: there is no such group, or it is taken, or all are.
    """
    if not name:
        candidates = [obj.vertex_groups.active.name, *obj.vertex_groups.keys()]
        name = next((name for name in candidates if name not in taken), "")
        if not name:
            raise CubicCraftError(f"Every vertex group already {already}")
    vertex_group(obj, name)
    if name in taken:
        raise CubicCraftError(f'"{name}" already {already}')
    return name
