# SPDX-License-Identifier: GPL-3.0-or-later
"""Cancel Cubify, or stop Cubify Animation, with a button."""

import bpy

from ..cubic_craft_addon import job


class CUBIC_CRAFT_OT_cubify_cancel(bpy.types.Operator):
    """Cancel what is running, like Esc."""

    bl_idname = "cubic_craft.cubify_cancel"
    bl_label = "Cancel"
    bl_description = (
        "Cancel Cubify, which has not changed anything yet (Esc). Cubify Animation keeps the frames"
        " that are done"
    )
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        """Something runs."""
        return job.current() is not None

    def execute(self, context):
        """End it."""
        running = job.current()
        if running is not None:
            running.stop()
        return {"FINISHED"}
