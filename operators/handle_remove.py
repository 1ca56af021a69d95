# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove a handle, and the empty that was made for it."""

import bpy

from ..cubic_craft_addon.handles.active import is_ours_alone
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.object_properties import active_entry, remove_active
from ._shared.selection import poll_handle


class CUBIC_CRAFT_OT_handle_remove(bpy.types.Operator):
    bl_idname = "cubic_craft.handle_remove"
    bl_label = "Remove Handle"
    bl_description = (
        "Remove the active handle and release its vertices. The vertex group is kept; an empty"
        " that was made for the handle is removed unless something else uses it"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return poll_handle(cls, context)

    def execute(self, context):
        obj = panel_object(context)
        target = active_entry(obj, "handle").target
        remove_active(obj, "handle")
        if target is not None and is_ours_alone(target):
            if context.view_layer.objects.active in (target, None):
                context.view_layer.objects.active = obj
                obj.select_set(True)
            bpy.data.objects.remove(target)
        return {"FINISHED"}
