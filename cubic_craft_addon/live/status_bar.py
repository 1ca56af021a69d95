# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys of Live in Blender's status bar."""

import bpy

_is_shown = False


def show(session):
    """Show the keys while the session runs."""
    global _is_shown

    def draw(header, _context):
        layout = header.layout
        if session.is_finishing:
            layout.label(text="Live is finishing")
        else:
            layout.label(text="Confirm Live", icon="EVENT_RETURN")
        layout.label(text="Cancel", icon="EVENT_ESC")
        layout.label(text="Cancel", icon="MOUSE_RMB")
        layout.label(text="", icon="EVENT_CTRL")
        layout.label(text="Undo", icon="EVENT_Z")

    bpy.context.workspace.status_text_set(draw)
    _is_shown = True


def hide():
    """Give the status bar back."""
    global _is_shown
    if _is_shown:
        _is_shown = False
        # A function, as opposed to a text, is shown in all workspaces: any of them can end it.
        bpy.data.workspaces[0].status_text_set(None)
