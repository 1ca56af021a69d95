# SPDX-License-Identifier: GPL-3.0-or-later
"""The poses of handles that are dragged while Live runs.

They are settings of Live and kept like those: outside Blender's undo stack, until Confirm transfers
them to the objects.
"""

from collections.abc import Mapping

import bpy

from ...solver.pieces.handle_pose import IDENTITY
from ..handles.own_pose import Pose, identify, own_pose
from ..handles.properties import CubicCraftHandle
from ..object_properties import object_properties
from . import handlers

Poses = Mapping[tuple[int, int], Pose]
"""by ``session_uid`` of the object and number of the handle (`identify`)"""

_poses: Poses = {}


def live_poses() -> Poses:
    """Return the poses that differ from those of the objects; the mapping never changes."""
    return _poses


def set_live_poses(poses: Poses) -> None:
    """Set all of them."""
    global _poses
    if poses != _poses:
        _poses = dict(poses)
        handlers.on_property(None, None)


def pose_of(obj: bpy.types.Object, handle: CubicCraftHandle) -> Pose:
    """Return the current pose of a handle itself, from Live or its own."""
    return _poses.get((obj.session_uid, handle.uid)) or own_pose(handle)


def set_pose(obj: bpy.types.Object, handle: CubicCraftHandle, pose: Pose) -> None:
    """Give a handle another pose while Live runs."""
    key = obj.session_uid, identify(handle)
    others = {other: kept for other, kept in _poses.items() if other != key}
    # Otherwise a drag that ends where it began would be a change.
    set_live_poses(others if pose == own_pose(handle) else {**others, key: pose})


def reset_poses(obj: bpy.types.Object) -> None:
    """Remove the poses of all handles of the object while Live runs."""
    for handle in object_properties(obj).handles:
        if pose_of(obj, handle) != IDENTITY:
            set_pose(obj, handle, IDENTITY)


def by_object(poses: Poses) -> dict[int, dict[int, Pose]]:
    """Return poses as `SettingsOverrides` takes them."""
    found: dict[int, dict[int, Pose]] = {}
    for (object_uid, handle_uid), pose in poses.items():
        found.setdefault(object_uid, {})[handle_uid] = pose
    return found
