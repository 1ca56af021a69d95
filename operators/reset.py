# SPDX-License-Identifier: GPL-3.0-or-later
"""Reset Settings: return all settings to their defaults."""

import bpy

from ..cubic_craft_addon import live
from ..cubic_craft_addon.settings.overrides import ALL, OF_EACH_OBJECT
from ._shared.selection import poll_panel_mesh


class CUBIC_CRAFT_OT_reset(bpy.types.Operator):
    bl_idname = "cubic_craft.reset"
    bl_label = "Reset Settings"
    bl_description = (
        "Reset all settings of the panel to their defaults. Handles, regions and painted groups"
        " are kept, and the mesh does not change until the next Cubify"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return poll_panel_mesh(cls, context)

    def execute(self, context):
        properties = live.shared_properties(live.panel_mesh(context))
        for name in ALL:
            if name not in OF_EACH_OBJECT:
                properties.property_unset(name)
        session = live.current()
        if session is not None:
            session.wake()
            return {"CANCELLED"}  # no undo step in the middle of Live
        return {"FINISHED"}
