# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the settings, in the header of the panel: ours, and those in the user's folder."""

from pathlib import Path

import bpy
from bl_ui.utils import PresetPanel

SUBFOLDER = "cubic_craft"
ADD_OPERATOR = "cubic_craft.preset_add"
OWN_FOLDER = Path(__file__).parent / "assets"
"""holds the presets that come with the extension, in ``presets/cubic_craft``"""


class CUBIC_PT_presets(PresetPanel, bpy.types.Panel):
    """The list of presets."""

    bl_label = "CubicCraft Presets"
    preset_subdir = SUBFOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = ADD_OPERATOR


_register_classes, _unregister_classes = bpy.utils.register_classes_factory((CUBIC_PT_presets,))


def register():
    """Add the list, with our own presets."""
    _register_classes()
    bpy.utils.register_preset_path(str(OWN_FOLDER))


def unregister():
    """Remove both."""
    bpy.utils.unregister_preset_path(str(OWN_FOLDER))
    _unregister_classes()
