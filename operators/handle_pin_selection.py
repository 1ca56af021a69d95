# SPDX-License-Identifier: GPL-3.0-or-later
"""Pin Selection: the selected vertices become a vertex group with a handle.

It leaves Edit Mode, because the undo steps of Edit Mode hold only the mesh: the handle would remain
without its vertex group. A single undo then reverts everything, back into Edit Mode.
"""

import bpy
import numpy as np

from ..cubic_craft_addon.handles.owner import panel_object
from ._shared.active_handle import add_handle, poll_mesh
from ._shared.selection import report_all

_GROUP = "Handle"


class CUBIC_CRAFT_OT_handle_pin_selection(bpy.types.Operator):
    """Hold the selected vertices."""

    bl_idname = "cubic_craft.handle_pin_selection"
    bl_label = "Pin Selection"
    bl_description = (
        "Hold the vertices that are selected in Edit Mode by making them a vertex group with a"
        " handle"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is a mesh, in Edit Mode or Object Mode."""
        return poll_mesh(cls, context, ("OBJECT", "EDIT_MESH"))

    def execute(self, context):
        """Make the vertex group and the handle."""
        obj = panel_object(context)
        obj.update_from_editmode()
        vertices = obj.data.vertices
        is_selected = np.empty(len(vertices), dtype=bool)
        vertices.foreach_get("select", is_selected)
        problem = ""
        if not is_selected.any():
            problem = "No vertex is selected; select some in Edit Mode first"
        elif is_selected.all():
            problem = "All vertices are selected; select fewer in Edit Mode first"
        if problem:
            return report_all(self, "", [problem])
        if obj.mode == "EDIT":
            bpy.ops.object.mode_set(mode="OBJECT")
        group = obj.vertex_groups.new(name=_GROUP)
        group.add(np.flatnonzero(is_selected).tolist(), 1.0, "REPLACE")
        add_handle(obj, group.name)
        count = int(is_selected.sum())
        return report_all(self, f'Pinned {count} vertices as "{group.name}"', [])
