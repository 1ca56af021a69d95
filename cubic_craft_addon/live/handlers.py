# SPDX-License-Identifier: GPL-3.0-or-later
"""Notifications from Blender to a running Live session, besides the events of its window."""

import bpy
from bpy.app.handlers import persistent

from ..environment import handlers
from .history import History
from .machine import Event

_session = None


def _told(method, *what):
    """Return a handler that calls a method of the session."""

    @persistent
    def tell(*_):
        getattr(_session, method)(*what)

    return tell


@persistent
def _on_update(_scene, depsgraph):
    """Distinguish what the artist has done from what Live itself has caused."""
    mesh_uids, shown_uids = _session.mesh_uids, _session.shown_uids
    for update in depsgraph.updates:
        data = update.id.original
        if isinstance(data, bpy.types.Mesh):
            if update.is_updated_geometry and data.session_uid in mesh_uids:
                _session.on_mesh_update()
        elif (
            isinstance(data, bpy.types.Object)
            and _session.is_following
            and data.data is not None
            and data.data.session_uid in mesh_uids
        ):
            _session.on_object_update()  # of a stroke in Sculpt Mode, Blender reports no more
        elif isinstance(data, bpy.types.Object) and (
            update.is_updated_transform
            or not update.is_updated_geometry
            or (data.data is not None and data.data.session_uid not in mesh_uids | shown_uids)
        ):
            # Moved, or one of its properties changed: a handle, a frame, or a live object itself;
            # or another object was edited, which a form may be made from.
            _session.wake()
        elif isinstance(data, bpy.types.Scene | bpy.types.Collection):
            _session.wake()  # perhaps an object was deleted, of which Blender does not notify us


_HANDLERS = (
    ("undo_post", _told("on_undo")),
    ("redo_post", _told("on_undo")),
    ("load_pre", _told("on", Event.LOAD)),
    ("save_pre", _told("on", Event.SAVE)),
    ("save_post", _told("on", Event.SAVED)),
    ("save_post_fail", _told("on", Event.SAVED)),
    ("frame_change_post", _told("on_object_update")),
    ("depsgraph_update_post", _on_update),
)


def install(session):
    """Notify the session of what happens."""
    global _session
    _session = session
    handlers.install(_HANDLERS)


def remove():
    """Undo `install`."""
    global _session
    handlers.remove(_HANDLERS)
    _session = None


def on_property(_properties, _context):
    """Wake the session, which has no timer while it is idle, as the update of a property."""
    if _session is not None:
        _session.wake()


def is_installed():
    """Return whether a session is notified of what happens."""
    return _session is not None


class UndoSteps:
    """Detects when the artist has done something that Blender can undo."""

    def __init__(self):
        self._last = _last_step()

    def tell(self, history: History) -> None:
        """Notify a history if the last step has changed since the last call."""
        before, self._last = self._last, _last_step()
        if self._last not in (before, 0):
            history.record_outside()


def _last_step():
    """Return an identifier of the last operator with an undo step, 0 for none."""
    steps = [op for op in bpy.context.window_manager.operators if "UNDO" in op.bl_options]
    return steps[-1].as_pointer() if steps else 0
