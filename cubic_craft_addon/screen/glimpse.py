# SPDX-License-Identifier: GPL-3.0-or-later
"""A brief view of the form while it is rotated by hand, even if its overlay is off."""

import contextlib
import time
from collections.abc import Iterator

import bpy

from .redraw import redraw_views

SECONDS = 1.5
"""seconds that the form stays visible"""

_until = 0.0
_is_quiet = False


def on_turn(_properties, _context):
    """Show the form from now on, as the update of a property that turns it."""
    global _until
    if _is_quiet:
        return
    _until = time.monotonic() + SECONDS
    if bpy.app.background:
        return
    redraw_views()
    if not bpy.app.timers.is_registered(_end):
        bpy.app.timers.register(_end, first_interval=SECONDS)


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Set properties without showing the form: this is not the artist who rotates it."""
    global _is_quiet
    before, _is_quiet = _is_quiet, True
    try:
        yield
    finally:
        _is_quiet = before


def is_seen() -> bool:
    """Return whether the form has just been rotated."""
    return time.monotonic() < _until


def _end():
    """Hide the form, or return the time to wait."""
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
