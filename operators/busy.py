# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands in the place of a button while Cubify runs (`ui/job_progress.py`)."""

import bpy

from ._shared.selection import poll_idle


class CUBIC_CRAFT_OT_busy(bpy.types.Operator):
    """A button that is always gray."""

    bl_idname = "cubic_craft.busy"
    bl_label = "Busy"
    bl_description = "Can be clicked again when Cubify has ended"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        """Never; the message says why."""
        poll_idle(cls)
        return False

    def execute(self, context):
        """Do nothing."""
        return {"CANCELLED"}
