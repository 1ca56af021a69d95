# SPDX-License-Identifier: GPL-3.0-or-later
"""Previews of Live that reappear without it: from an undo step, a file, or a crash."""

import bpy
from bpy.app.handlers import persistent

from .. import mesh_bridge
from ..environment.handlers import install, remove
from . import handlers


@persistent
def _heal(*_):
    if not handlers.is_installed():
        mesh_bridge.end_all_previews()


_HANDLERS = [(name, _heal) for name in ("undo_post", "redo_post", "load_post")]


def register():
    """Watch for them."""
    install(_HANDLERS)
    # The file that is open now; at startup it cannot be read while extensions are registered.
    bpy.app.timers.register(_heal, first_interval=0.0)


def unregister():
    """Stop watching."""
    remove(_HANDLERS)
    if bpy.app.timers.is_registered(_heal):
        bpy.app.timers.unregister(_heal)
