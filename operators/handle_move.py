# SPDX-License-Identifier: GPL-3.0-or-later
"""Move a handle in the list: where handles overlap, the first takes precedence."""

import bpy
from bpy.props import EnumProperty

from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.object_properties import object_properties
from ._shared.selection import poll_handle, refuse


class CUBIC_CRAFT_OT_handle_move(bpy.types.Operator):
    """Move the active handle up or down the list."""

    bl_idname = "cubic_craft.handle_move"
    bl_label = "Move Handle"
    bl_description = (
        "Move the active handle up or down in the list; where handles overlap, the first takes"
        " precedence"
    )
    bl_options = {"REGISTER", "UNDO"}

    direction: EnumProperty(
        name="Direction",
        items=(("UP", "Up", "Toward the first"), ("DOWN", "Down", "Toward the last")),
    )

    @classmethod
    def poll(cls, context):
        if not poll_handle(cls, context):
            return False
        if len(object_properties(panel_object(context)).handles) < 2:
            return refuse(cls, "There is only one handle")
        return True

    def execute(self, context):
        properties = object_properties(panel_object(context))
        place = properties.active_handle + (-1 if self.direction == "UP" else 1)
        if not 0 <= place < len(properties.handles):
            return {"CANCELLED"}
        properties.handles.move(properties.active_handle, place)
        properties.active_handle = place
        return {"FINISHED"}
