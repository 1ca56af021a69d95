# SPDX-License-Identifier: GPL-3.0-or-later
"""Previews of Live that reappear without it: from an undo step, a file, or a crash.

What a file shows is kept: it was written while Live ran, by Blender's autosave for example, which
tells nobody. An undo step is from before the artist ended Live, and has the shape from before.
"""

import logging
from dataclasses import asdict
from typing import Any

import bpy
from bpy.app.handlers import persistent

from .. import mesh_bridge
from ..environment.handlers import install, remove
from ..object_properties import object_properties, users_of
from ..run.failures import UNEXPECTED
from ..run.up_to_date import what_matters
from ..screen import glimpse
from ..settings.overrides import ALL
from ..settings.properties import settings_of
from ..settings.rollback import settings_kept
from ..settings.values import Settings
from . import handlers
from .follower import release, remove_left

_log = logging.getLogger(__name__)


@persistent
def _heal(*_):
    if not handlers.is_installed():
        remove_left()
        mesh_bridge.end_all_previews()


@persistent
def _keep(*_):
    if handlers.is_installed():
        return
    for mesh in bpy.data.meshes:
        _keep_if_noted(mesh)
    mesh_bridge.end_all_previews()
    remove_left()


def _keep_if_noted(mesh):
    outcome = mesh_bridge.noted_outcome(mesh)
    if outcome is None or mesh.is_editmode:  # where only the shape from before can be written
        return
    try:
        with settings_kept([mesh]):
            _keep_one(mesh, outcome)
    except UNEXPECTED:  # a file may say anything; what was there before Live is safe
        _log.exception("The preview on %s is not kept", mesh.name)


def leave(follower: bpy.types.Object) -> None:
    """Make what a follower shows a result, and the follower an object like any other."""
    mesh = mesh_bridge.mesh_of(follower)
    _keep_if_noted(mesh)
    mesh_bridge.end_preview(mesh)
    release(follower)


def _keep_one(mesh: bpy.types.Mesh, outcome: Any) -> None:
    """Make the shape that is seen a result, with the settings that it was made with."""
    values = {name: value for name, value in outcome["values"].items() if name in ALL}
    objects = list(users_of([mesh]))
    if not objects or values["result"] != "MESH":
        return
    start = object_properties(objects[0]).start
    values["start"] = Settings.start  # it has been for this run
    with glimpse.quiet():
        for obj in objects:
            for name, value in values.items():
                setattr(object_properties(obj), name, value)
    run = mesh_bridge.LastRun(
        what_matters(settings_of(objects[0])), **outcome["run"], own_vertices=len(mesh.vertices)
    )
    mesh_bridge.keep_preview(mesh, asdict(run), start)
    mesh_bridge.shade_edges(objects[0], values["sharp_edges"])


_HANDLERS = (("undo_post", _heal), ("redo_post", _heal), ("load_post", _keep))


def register():
    """Watch for them."""
    install(_HANDLERS)
    # The file that is open now; at startup it cannot be read while extensions are registered.
    bpy.app.timers.register(_keep, first_interval=0.0)


def unregister():
    """Stop watching."""
    remove(_HANDLERS)
    if bpy.app.timers.is_registered(_keep):
        bpy.app.timers.unregister(_keep)
