# SPDX-License-Identifier: GPL-3.0-or-later
"""Follow an Empty: create the object that a handle follows."""

import bpy

from ..cubic_craft_addon.handles.active import add_empty
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.handles.pose import live_target
from ..cubic_craft_addon.object_properties import active_entry
from ._shared.selection import poll_handle, refuse, report_all
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_handle_follow(bpy.types.Operator):
    bl_idname = "cubic_craft.handle_follow"
    bl_label = "Follow an Empty"
    bl_description = (
        "Add an empty at the center of the handle's vertices and select it. When you move, rotate"
        " or scale it, the next Cubify moves the vertices along and bends the rest"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not poll_handle(cls, context):
            return False
        target = live_target(active_entry(panel_object(context), "handle"))
        if target is not None:
            return refuse(cls, f'The handle already follows "{target.name}"')
        return True

    @reporting
    def execute(self, context):
        obj = panel_object(context)
        handle = active_entry(obj, "handle")
        empty = add_empty(context, obj, handle)
        handle.target = empty  # binds it
        if context.view_layer.objects.get(empty.name) == empty:
            bpy.ops.object.select_all(action="DESELECT")
            empty.select_set(True)
            context.view_layer.objects.active = empty
        return report_all(self, f'"{handle.group}" follows "{empty.name}"', [])
