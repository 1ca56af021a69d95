# SPDX-License-Identifier: GPL-3.0-or-later
"""Save Preset: save the current look under a name."""

import bpy
from bpy.props import StringProperty

from ..cubic_craft_addon.live import shared_properties
from ..cubic_craft_addon.presets import files
from ._shared.selection import panel_mesh, poll_panel_mesh
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_preset_add(bpy.types.Operator):
    """Save the look that the panel shows as a preset, for all files."""

    bl_idname = "cubic_craft.preset_add"
    bl_label = "Save Preset"
    bl_description = (
        "Save the current look under a name, for all files: cubeness, solidity, and what stays"
        " together. This replaces a preset of yours with the same name"
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
        """There is a mesh in the panel."""
        return poll_panel_mesh(cls, context)

    def invoke(self, context, event):
        """Ask for the name."""
        return context.window_manager.invoke_props_dialog(self)

    @reporting
    def execute(self, context):
        """Write the file."""
        properties = shared_properties(panel_mesh(context))
        path = files.save(self.name, properties)
        properties.preset = path.stem  # among presets with equal settings, this one is shown
        self.report({"INFO"}, f'Saved "{files.find(path.stem).name}"')
        return {"FINISHED"}
