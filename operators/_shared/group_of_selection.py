# SPDX-License-Identifier: GPL-3.0-or-later
"""A vertex group of the vertices that are selected in Edit Mode."""

import bpy
import numpy as np

from ...cubic_craft_addon import mesh_bridge
from ...solver import CubicCraftError


def group_of_selection(obj: bpy.types.Object, name: str) -> tuple[bpy.types.VertexGroup, int]:
    """Make a vertex group of the selected vertices of a mesh, and return it and their number.

    This leaves Edit Mode, because the undo steps of Edit Mode hold only the mesh: what refers to
    the group would remain without it. A single undo then reverts everything, back into Edit Mode.

    Raises CubicCraftError: no vertex is selected, or all are.
    """
    obj.update_from_editmode()
    is_selected = mesh_bridge.read_values(mesh_bridge.mesh_of(obj).vertices, "select", bool)
    if not is_selected.any():
        raise CubicCraftError("No vertex is selected; select some in Edit Mode first")
    if is_selected.all():
        raise CubicCraftError("All vertices are selected; select fewer in Edit Mode first")
    if obj.mode == "EDIT":
        bpy.ops.object.mode_set(mode="OBJECT")
    group = obj.vertex_groups.new(name=name)
    group.add(np.flatnonzero(is_selected).tolist(), 1.0, "REPLACE")
    return group, int(is_selected.sum())
