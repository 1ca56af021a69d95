# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove Preset: delete the current preset."""

import bpy

from ..cubic_craft_addon import live
from ..cubic_craft_addon.presets import files
from ..cubic_craft_addon.presets.selector import preset_of
from ._shared.selection import panel_mesh, poll_panel_mesh, refuse
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_preset_remove(bpy.types.Operator):
    """Delete the preset that the panel shows; the settings do not change."""

    bl_idname = "cubic_craft.preset_remove"
    bl_label = "Remove Preset"
    bl_description = "Delete the current preset, for all files; the settings do not change"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        """There is a preset of the artist in the panel."""
        if not poll_panel_mesh(cls, context):
            return False
        preset = preset_of(live.shared_properties(panel_mesh(context)))
        if preset is None or preset.is_included:
            return refuse(
                cls, "Choose one of your own presets first; included presets cannot be removed"
            )
        return True

    def invoke(self, context, event):
        """Ask first: there is no undo."""
        return context.window_manager.invoke_confirm(self, event)

    @reporting
    def execute(self, context):
        """Delete the file."""
        preset = preset_of(live.shared_properties(panel_mesh(context)))
        assert preset is not None  # as `poll` has found
        files.remove(preset)
        self.report({"INFO"}, f'Removed "{preset.name}"')
        return {"FINISHED"}
