# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the settings, in the header of the panel: kept by Blender in the user's folder."""

import bpy
from bl_ui.utils import PresetPanel

SUBFOLDER = "cubic_craft"
ADD_OPERATOR = "cubic_craft.preset_add"


class CUBIC_PT_presets(PresetPanel, bpy.types.Panel):
    """The list of presets."""

    bl_label = "CubicCraft Presets"
    preset_subdir = SUBFOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = ADD_OPERATOR


register, unregister = bpy.utils.register_classes_factory((CUBIC_PT_presets,))
