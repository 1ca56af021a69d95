# SPDX-License-Identifier: GPL-3.0-or-later
"""Reset Pose: what the handles follow goes back to where nothing moves."""

import bpy

from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.handles.pose import followed, reset
from .active_handle import poll_mesh


class CUBIC_CRAFT_OT_handle_reset_pose(bpy.types.Operator):
    """Put what the handles follow back to where it was when they began to follow it."""

    bl_idname = "cubic_craft.handle_reset_pose"
    bl_label = "Reset Pose"
    bl_description = (
        "Put the objects that the handles follow back to where they were at the beginning; the"
        " next Cubify then leaves the vertices of the handles in place"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is a handle that follows something."""
        if not poll_mesh(cls, context):
            return False
        if not any(True for _ in followed(panel_object(context))):
            cls.poll_message_set("No handle follows anything")
            return False
        return True

    def execute(self, context):
        """Put each target back."""
        obj = panel_object(context)
        for handle, target in followed(obj):
            if target != obj:
                reset(obj, handle)
        return {"FINISHED"}
