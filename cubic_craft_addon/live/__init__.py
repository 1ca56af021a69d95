# SPDX-License-Identifier: GPL-3.0-or-later
"""Live: the mesh moves toward its cubic shape while the artist watches and changes settings.

``machine`` and ``history`` decide, without Blender; ``session`` does it, on ``live_mesh`` for each
mesh; the operator in ``operators/live.py`` passes events on.
"""

import bpy

from ..properties import settings_of
from ..settings import Settings
from . import healing, properties
from .machine import Event
from .properties import live_choice, live_properties
from .session import Session

__all__ = ("Event", "begin", "current", "live_properties", "register", "settings_now", "unregister")

_session: Session | None = None


def begin(context, objects) -> Session:
    """Start the session; there is at most one.

    Raises
    ------
    CubicCraftError
        As `Session`.
    """
    global _session
    assert current() is None
    _session = Session(context, objects)
    return _session


def current() -> Session | None:
    """Return the running session, or None."""
    return None if _session is None or _session.is_ended else _session


def settings_now(obj: bpy.types.Object) -> Settings:
    """Return the settings that the panel shows for an object.

    Raises
    ------
    CubicCraftError
        As `live_choice`.
    """
    return live_choice([obj]).settings_for(obj) if current() else settings_of(obj)


def register():
    """Add the settings of Live, and watch out for what is left of it in files."""
    properties.register()
    healing.register()


def unregister():
    """End a running session, then take all back."""
    session = current()
    if session is not None:
        session.on(Event.DISABLED)
    healing.unregister()
    properties.unregister()
