# SPDX-License-Identifier: GPL-3.0-or-later
"""The artist goes on with something else while Live runs: another mesh, or another mode."""

from collections.abc import Iterable
from typing import Any

import bpy

from ..environment.modes import MODES
from ..object_properties import has_properties, object_properties
from ..settings.overrides import POINTERS
from . import properties


def place_of(context: bpy.types.Context) -> tuple[int | None, int | None]:
    """Return ``session_uid`` of the workspace and of the scene that the artist is in."""
    places = context.workspace, context.scene
    workspace, scene = (None if place is None else place.session_uid for place in places)
    return workspace, scene


def objects_of(context: bpy.types.Context, place: tuple[int | None, int | None]) -> Iterable[Any]:
    """Return the objects of the view layer, or those of the scene if the artist has left it."""
    if context.scene is not None and context.scene.session_uid == place[1]:
        return context.view_layer.objects
    scenes = [scene for scene in bpy.data.scenes if scene.session_uid == place[1]]
    return scenes[0].objects if scenes else []


def is_another_mesh_active(objects: list[bpy.types.Object]) -> bool:
    """Return whether a mesh is active that Live has nothing to do with.

    Those that its objects follow or take their form from are moved and edited meanwhile.
    """
    active = bpy.context.view_layer.objects.active
    if active is None or active.type != "MESH" or active in objects or not active.select_get():
        return False
    names = [getattr(properties.live_properties(), name) for name in POINTERS]
    return active.name not in names and not any(_depends_on(obj, active) for obj in objects)


def _depends_on(obj, other):
    if not has_properties(obj):
        return False
    own = object_properties(obj)
    targets = [handle.target for handle in own.handles]
    return other in targets or other in [region.form_object for region in own.regions]


def leave_mode(objects: list[bpy.types.Object]) -> Any:
    """Go to Object Mode if one of the objects is in a mode in which it cannot be written.

    Returns the mode that was left, or an empty text.
    """
    active = bpy.context.view_layer.objects.active
    if active is None or all(obj.mode in MODES for obj in objects):
        return ""
    mode = active.mode
    bpy.ops.object.mode_set(mode="OBJECT")
    return mode


def back_to_mode(mode: Any, *, has_written: bool) -> None:
    """Return to the mode that was left.

    What was written becomes an undo step of its own: one from inside the mode would not have all.
    """
    if has_written:
        bpy.ops.ed.undo_push(message="Live")
    bpy.ops.object.mode_set(mode=mode)
    if has_written:
        bpy.ops.ed.undo_push(message="Mode")


def push_undo() -> None:
    """Push an undo step, unless Blender quits."""
    windows = bpy.context.window_manager.windows
    if windows:
        with bpy.context.temp_override(window=windows[0]):
            bpy.ops.ed.undo_push(message="Live")
