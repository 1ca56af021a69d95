# SPDX-License-Identifier: GPL-3.0-or-later
"""Redraw the panel, which Blender does by itself only after changes by the artist."""

import bpy


def redraw_panels() -> None:
    """Draw the sidebars of all viewports with the next redraw."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()
