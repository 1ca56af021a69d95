# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys of Live in Blender's status bar."""

from ..screen import status_text


def show(session):
    """Show the keys while the session runs."""

    def draw(header, _context):
        layout = header.layout
        if session.is_finishing:
            layout.label(text="Live is finishing")
        else:
            layout.label(text="Confirm Live", icon="EVENT_RETURN")
        layout.label(text="Cancel", icon="EVENT_ESC")
        layout.label(text="", icon="EVENT_CTRL")
        layout.label(text="Undo", icon="EVENT_Z")

    status_text.show(draw)


def hide():
    """Restore the status bar."""
    status_text.hide()
