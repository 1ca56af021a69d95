# SPDX-License-Identifier: GPL-3.0-or-later
"""Live: the mesh moves toward its cubic shape while the artist watches and changes settings.

``machine`` and ``history`` decide, without Blender; ``session`` carries it out, with a
``live_mesh`` for each mesh; the operator in ``operators/live.py`` passes events on.
"""

from dataclasses import replace
from typing import Any

import bpy

from ..handles.owner import panel_object
from ..object_properties import object_properties
from ..settings.properties import settings_of
from ..settings.values import Settings
from . import properties, stale_previews
from .machine import Event
from .poses import pose_of, reset_poses, set_pose
from .properties import live_overrides, live_properties
from .session import Session

_session: Session | None = None


def begin(context, objects) -> Session:
    """Start the session; there is at most one.

    Raises CubicCraftError: as `Session`.
    """
    global _session
    assert current() is None
    _session = Session(context, objects)
    return _session


def current() -> Session | None:
    """Return the running session, or None."""
    return None if _session is None or _session.is_ended else _session


def panel_mesh(context: bpy.types.Context) -> Any:
    """Return the mesh object whose settings the panel shows, None if it shows none."""
    session = current()
    return panel_object(context) or (session and session.first_object(context))


def shared_properties(obj: bpy.types.Object):
    """Return the holder of the settings that all objects of a run share."""
    return live_properties() if current() else object_properties(obj)


def own_properties(obj: bpy.types.Object):
    """Return the holder of the settings that each object of a run keeps (`OF_EACH_OBJECT`)."""
    session = current()
    return live_properties() if session and session.is_single else object_properties(obj)


def settings_now(obj: bpy.types.Object) -> Settings:
    """Return the settings that the panel shows for an object, without its handles.

    Raises CubicCraftError: as `live_overrides`.
    """
    if current() is None:
        return settings_of(obj, handles=())
    return replace(live_overrides([obj]), handles=()).settings_for(obj)


def register():
    """Add the settings of Live, and watch for previews left in files."""
    properties.register()
    stale_previews.register()


def unregister():
    """End a running session, then undo `register`."""
    session = current()
    if session is not None:
        session.on(Event.DISABLED)
    stale_previews.unregister()
    properties.unregister()
