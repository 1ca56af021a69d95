# SPDX-License-Identifier: GPL-3.0-or-later
"""Previews of Live that reappear without it: from an undo step, a file, or a crash."""

import bpy
from bpy.app.handlers import persistent

from .. import mesh_bridge
from . import handlers


@persistent
def _heal(*_):
    if not handlers.is_installed():
        mesh_bridge.end_all_previews()


_NAMES = ("undo_post", "redo_post", "load_post")


def register():
    """Watch for them."""
    for name in _NAMES:
        getattr(bpy.app.handlers, name).append(_heal)
    # The file that is open now; at startup it cannot be read while extensions are registered.
    bpy.app.timers.register(_heal, first_interval=0.0)


def unregister():
    """Stop watching."""
    for name in _NAMES:
        getattr(bpy.app.handlers, name).remove(_heal)
    if bpy.app.timers.is_registered(_heal):
        bpy.app.timers.unregister(_heal)
