# SPDX-License-Identifier: GPL-3.0-or-later
"""While Cubify runs: the button that cancels it, and what stands in the place of others."""

import bpy

from ..cubic_craft_addon import job
from ._shared.selection import poll_idle


class CUBIC_CRAFT_OT_cubify_cancel(bpy.types.Operator):
    bl_idname = "cubic_craft.cubify_cancel"
    bl_label = "Cancel"
    bl_description = (
        "Cancel Cubify, which has not changed anything yet (Esc). Cubify Animation keeps the frames"
        " that are done"
    )
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        return job.current() is not None

    def execute(self, context):
        running = job.current()
        if running is not None:
            running.stop()
        return {"FINISHED"}


class CUBIC_CRAFT_OT_busy(bpy.types.Operator):
    """A button that is always gray, see `ui/buttons.py`."""

    bl_idname = "cubic_craft.busy"
    bl_label = "Busy"
    bl_description = "Can be clicked again when Cubify has ended"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        poll_idle(cls)
        return False
