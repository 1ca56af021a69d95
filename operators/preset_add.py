# SPDX-License-Identifier: GPL-3.0-or-later
"""Add or remove a preset of the settings."""

import bpy
from bl_operators.presets import AddPresetBase

from ..cubic_craft_addon.choice import ALL, OF_EACH_OBJECT
from ..cubic_craft_addon.presets import ADD_OPERATOR, SUBFOLDER, CUBIC_PT_presets


class CUBIC_CRAFT_OT_preset_add(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of the settings of the active object."""

    bl_idname = ADD_OPERATOR
    bl_label = "Add CubicCraft Preset"
    bl_description = "Add or remove a preset of these settings; vertex groups are not part of it"
    preset_menu = CUBIC_PT_presets.__name__
    preset_subdir = SUBFOLDER
    # In full: Blender 4 forgets `preset_defines` on Python 3.13, which distributions give it.
    preset_values = tuple(
        f"bpy.context.object.cubic_craft.{name}" for name in ALL if name not in OF_EACH_OBJECT
    )
