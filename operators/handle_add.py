# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a handle that holds a vertex group of the mesh."""

import bpy
from bpy.props import StringProperty

from ..cubic_craft_addon.handles.active import add_handle
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.object_properties import object_properties
from ..solver.errors import CubicCraftError
from ._shared.group_to_add import group_to_add, poll_groups
from ._shared.selection import report_all


class CUBIC_CRAFT_OT_handle_add(bpy.types.Operator):
    """Hold the vertices of a vertex group."""

    bl_idname = "cubic_craft.handle_add"
    bl_label = "Add Handle"
    bl_description = (
        "Hold the vertices of the active vertex group, or of the first group that is not held yet"
    )
    bl_options = {"REGISTER", "UNDO"}

    group: StringProperty(
        name="Vertex Group",
        description="Vertex group to hold; empty for the active one",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        """There is a mesh with a vertex group."""
        return poll_groups(cls, context, "Pin Selection")

    def execute(self, context):
        """Add the handle, pinned."""
        obj = panel_object(context)
        held = {handle.group for handle in object_properties(obj).handles}
        try:
            self.group = group_to_add(obj, self.group, held, "has a handle")
        except CubicCraftError as error:
            return report_all(self, "", [str(error)])
        add_handle(obj, self.group)
        return report_all(self, f'Added a handle for "{self.group}"', [])
