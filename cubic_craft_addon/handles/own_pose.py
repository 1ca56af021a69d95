# SPDX-License-Identifier: GPL-3.0-or-later
"""The pose that a handle has of itself: a matrix P, by which its vertices are moved.

It is given in the coordinates of the object, so that it goes along with that. Where the handle
follows an object as well, that moves the vertices on from there.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ...solver.errors import CubicCraftError
from ..object_properties import object_properties
from .handle import IDENTITY

if TYPE_CHECKING:
    from .properties import CubicCraftHandle

Pose = tuple[float, ...]
"""16 numbers, row by row, of single precision"""
SMALLEST_SCALE = 1e-6
"""relative; what is flatter has no inverse worth the name"""


def own_pose(handle: CubicCraftHandle) -> Pose:
    """Return the pose that is kept with the handle."""
    return tuple(value for row in handle.pose for value in row)


def check_pose(obj: bpy.types.Object, handle: CubicCraftHandle, pose: Pose) -> None:
    """Refuse a pose that cannot be used.

    Raises
    ------
    CubicCraftError
        It is no affine map, or flattens the vertices; the message names the handle and the cure.
    """
    if pose == IDENTITY:
        return
    matrix = np.reshape(pose, (4, 4))
    if np.isfinite(matrix).all() and pose[12:] == IDENTITY[12:]:
        sizes = np.linalg.svd(matrix[:3, :3], compute_uv=False)
        if sizes[-1] > SMALLEST_SCALE * sizes[0]:
            return
    raise CubicCraftError(
        f'the pose of the handle "{handle.group}" of "{obj.name}" is no affine map, or has a scale'
        " of zero; click Reset Pose, or give it as a mathutils.Matrix (Blender takes a plain list"
        " by its columns)"
    )


def has_pose(handle: CubicCraftHandle) -> bool:
    """Return whether the handle has a pose of its own."""
    return own_pose(handle) != IDENTITY


def set_own_pose(handle: CubicCraftHandle, pose: Pose) -> None:
    """Keep a pose with the handle."""
    handle.pose = Matrix(np.reshape(pose, (4, 4)).tolist())


def identify(handle: CubicCraftHandle) -> int:
    """Return a number that tells the handle from the others of its object, whatever its place."""
    if not handle.uid:
        handle.uid = random.randrange(1, 2**31)
    return handle.uid


def keep_poses(obj: bpy.types.Object, poses: Mapping[int, Pose]) -> None:
    """Keep poses, by the numbers of `identify`, with the object's handles."""
    for handle in object_properties(obj).handles:
        if handle.uid in poses:
            set_own_pose(handle, poses[handle.uid])


def pose_since_baked(handle: CubicCraftHandle) -> Matrix:
    """Return the pose as it is from where it was when the mesh was written."""
    if handle.pose == handle.baked_pose:
        return Matrix()
    return handle.pose @ handle.baked_pose.inverted_safe()
