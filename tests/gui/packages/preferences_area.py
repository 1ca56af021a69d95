# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's preferences beside the viewport, at the section of the extensions, and what is there."""

import sys
from pathlib import Path

import bpy
import guidrive as gui

WHERE = {"region_type": "WINDOW", "area_type": "PREFERENCES"}


def open_preferences():
    """Split the viewport and show the extensions in one half."""
    with gui.in_region():
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.45)
    yield from gui.wait_until(
        lambda: sum(area.type == "VIEW_3D" for area in gui.window().screen.areas) == 2,
        what="two viewports",
    )
    views = [area for area in gui.window().screen.areas if area.type == "VIEW_3D"]
    bpy.context.preferences.active_section = "EXTENSIONS"
    max(views, key=lambda area: area.x).type = "PREFERENCES"
    yield from redraw()


def redraw():
    """Let Blender draw the preferences anew."""
    for _ in range(3):
        gui.area("PREFERENCES").tag_redraw()
        yield from gui.wait_redraw()


def press(operator, times=1):
    """Click on a button of the preferences, found by its operator."""
    button = yield from gui.find_button(operator, **WHERE)
    for _ in range(times):
        yield from gui.click(button)


def extensions():
    """Return Blender's folder of extensions."""
    return Path(bpy.utils.user_resource("EXTENSIONS"))


def unpacked_wheels():
    """Return the names of what Blender has unpacked from wheels."""
    version = f"python{sys.version_info[0]}.{sys.version_info[1]}"
    folder = extensions() / ".local" / "lib" / version / "site-packages"
    return {path.name for path in folder.iterdir()} if folder.exists() else set()
