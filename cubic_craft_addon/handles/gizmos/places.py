# SPDX-License-Identifier: GPL-3.0-or-later
"""The positions and axes of the handles that can be dragged."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ... import live
from ...object_properties import object_properties
from ..own_pose import Pose, is_invertible
from ..owner import panel_object
from ..pose import live_target


@dataclass(frozen=True)
class Place:
    """A handle that can be dragged."""

    number: int
    """in the list of the object"""
    pose: Pose
    center: np.ndarray
    """(3,) in object space, as it is posed"""
    world: np.ndarray
    """(4,4) of the object"""

    @property
    def center_in_world(self):
        """(3,) of the world."""
        return self.world[:3, :3] @ self.center + self.world[:3, 3]

    @property
    def own_axes(self):
        """(3,3) orthonormal axes that rotate with the handle, in the world, as columns."""
        linear = self.world[:3, :3] @ np.reshape(self.pose, (4, 4))[:3, :3]
        U, _, Vt = np.linalg.svd(linear)
        axes = U @ Vt
        return axes if np.linalg.det(axes) > 0.0 else -axes


def live_object(context: bpy.types.Context) -> Any:
    """Return the live object whose handles can be dragged, None if there is none."""
    session = live.current()
    if session is None or context.mode != "OBJECT":
        return None
    obj = panel_object(context)
    if obj is None or not obj.visible_get():
        return None
    return obj if _member_of(session, obj) is not None else None


def places_of(obj: bpy.types.Object) -> list[Place]:
    """Return the handles of a live object that can be dragged."""
    numbers = range(len(object_properties(obj).handles))
    found = [place_of(obj, number) for number in numbers]
    return [place for place in found if place is not None]


def place_of(obj: bpy.types.Object, number: int) -> Place | None:
    """Return a handle of a live object, None if it cannot be dragged.

    Handles that follow a target cannot: the target is moved instead.
    """
    member = _member_of(live.current(), obj)
    handles = object_properties(obj).handles
    seen = member.settings.handles if member is not None else ()
    if member is None or number >= len(handles) or number >= len(seen):
        return None
    handle, world = handles[number], np.array(obj.matrix_world, dtype=np.float64)
    # Live may not have noticed a change of the list yet.
    is_seen = handle.group == seen[number].group and live_target(handle) is None
    middle = middle_of(member.shape.original[member.handle_of == number])
    if not is_seen or middle is None or not is_invertible(world):
        return None
    pose = live.pose_of(obj, handle)
    center = np.reshape(pose, (4, 4)) @ np.append(middle, 1.0)
    return Place(number, pose, center[:3], world)


def middle_of(points: np.ndarray) -> np.ndarray | None:
    """Return the middle (3,) of the box around points (n,3), None if there are none."""
    points = points.astype(np.float64)
    return (points.min(axis=0) + points.max(axis=0)) / 2 if len(points) else None


def _member_of(session, obj):
    """Return the data that Live has read from an object, None if it is not live itself."""
    mesh = session.mesh_of(obj) if session is not None else None
    return mesh.member if mesh is not None and mesh.object_uid == obj.session_uid else None
