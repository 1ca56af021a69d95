# SPDX-License-Identifier: GPL-3.0-or-later
"""Save the current look under a name as a preset, or remove the current preset."""

import bpy
from bpy.props import StringProperty

from ..cubic_craft_addon.live import panel_mesh, shared_properties
from ..cubic_craft_addon.presets import files
from ..cubic_craft_addon.presets.selector import preset_of
from ._shared.selection import poll_panel_mesh, refuse
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_preset_add(bpy.types.Operator):
    bl_idname = "cubic_craft.preset_add"
    bl_label = "Save Preset"
    bl_description = (
        "Save the current look under a name, for all files: how cubic and crisp, which details"
        " remain, and what stays together. This replaces a preset of yours with the same name"
    )
    bl_options = {"INTERNAL"}

    name: StringProperty(
        name="Name",
        description="Name of the preset",
        default="My Look",
        maxlen=64,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        return poll_panel_mesh(cls, context)

    def invoke(self, context, event):
        """Ask for the name."""
        return context.window_manager.invoke_props_dialog(self)

    @reporting
    def execute(self, context):
        properties = shared_properties(panel_mesh(context))
        path = files.save(self.name, properties)
        properties.preset = path.stem  # among presets with equal settings, this one is shown
        self.report({"INFO"}, f'Saved "{files.find(path.stem).name}"')
        return {"FINISHED"}


class CUBIC_CRAFT_OT_preset_remove(bpy.types.Operator):
    bl_idname = "cubic_craft.preset_remove"
    bl_label = "Remove Preset"
    bl_description = "Delete the current preset, for all files; the settings do not change"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        if not poll_panel_mesh(cls, context):
            return False
        preset = preset_of(shared_properties(panel_mesh(context)))
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
        preset = preset_of(shared_properties(panel_mesh(context)))
        assert preset is not None  # as `poll` has found
        files.remove(preset)
        self.report({"INFO"}, f'Removed "{preset.name}"')
        return {"FINISHED"}
