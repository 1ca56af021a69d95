# SPDX-License-Identifier: GPL-3.0-or-later
"""A brief view of the cube after it was rotated, even if its overlay is off."""

import time

import bpy

SECONDS = 1.5
"""seconds that the cube stays visible"""

_until = 0.0


def on_turn(_properties, _context):
    """Show the cube from now on, as the update of a property that turns it."""
    global _until
    _until = time.monotonic() + SECONDS
    if bpy.app.background:
        return
    redraw_views()
    if not bpy.app.timers.is_registered(_end):
        bpy.app.timers.register(_end, first_interval=SECONDS)


def is_seen() -> bool:
    """Return whether the cube has just been rotated."""
    return time.monotonic() < _until


def redraw_views() -> None:
    """Redraw all 3D viewports."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _end():
    """Hide the cube, or return the time to wait."""
    remaining = _until - time.monotonic()
    if remaining > 0.0:
        return remaining
    redraw_views()
    return None


def forget() -> None:
    """Stop waiting for the end of a glimpse."""
    global _until
    _until = 0.0
    if bpy.app.timers.is_registered(_end):
        bpy.app.timers.unregister(_end)
