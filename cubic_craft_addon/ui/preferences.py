# SPDX-License-Identifier: GPL-3.0-or-later
"""The preferences of the extension."""

import bpy
from bpy.props import StringProperty

from ..environment.kernel_cache import ROOT_PACKAGE
from . import panel


def _move_panel(preferences, _context):
    panel.move_to_tab(preferences.tab)


class CubicCraftPreferences(bpy.types.AddonPreferences):
    """Where the panel is."""

    bl_idname = ROOT_PACKAGE

    tab: StringProperty(
        name="Sidebar Tab",
        description="Name of the sidebar tab that contains the panel",
        default=panel.DEFAULT_TAB,
        update=_move_panel,
    )

    def draw(self, context):
        """Draw the preferences."""
        self.layout.use_property_split = True
        self.layout.prop(self, "tab")


def register():
    """Register the preferences and take over the tab that was saved."""
    bpy.utils.register_class(CubicCraftPreferences)
    addon = bpy.context.preferences.addons.get(ROOT_PACKAGE)
    if addon is not None:
        panel.CUBIC_CRAFT_PT_main.bl_category = addon.preferences.tab or panel.DEFAULT_TAB


def unregister():
    """Unregister the preferences."""
    bpy.utils.unregister_class(CubicCraftPreferences)
