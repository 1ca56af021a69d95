# SPDX-License-Identifier: GPL-3.0-or-later
"""The own pose of a handle: a matrix P that moves its vertices.

It is in the coordinates of the object, so that it follows the object. If the handle also follows
a target, the target moves the vertices from there.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ...solver.errors import CubicCraftError
from ...solver.pieces.handle_pose import IDENTITY
from ..object_properties import object_properties

if TYPE_CHECKING:
    from .properties import CubicCraftHandle

Pose = tuple[float, ...]
"""16 numbers, row by row, of single precision"""
_SMALLEST_SCALE = 1e-6  # relative; flatter matrices have no usable inverse


def own_pose(handle: CubicCraftHandle) -> Pose:
    """Return the pose stored with the handle."""
    return tuple(value for row in handle.pose for value in row)


def is_invertible(matrix: np.ndarray) -> bool:
    """Return whether a matrix (4,4) is finite and flattens nothing."""
    if not np.isfinite(matrix).all():
        return False
    sizes = np.linalg.svd(matrix[:3, :3], compute_uv=False)
    return bool(sizes[-1] > _SMALLEST_SCALE * sizes[0])


def check_pose(obj: bpy.types.Object, handle: CubicCraftHandle, pose: Pose) -> None:
    """Refuse an invalid pose.

    Raises CubicCraftError: it is not an affine map, or flattens the vertices; the message names the
    handle and the remedy.
    """
    if pose == IDENTITY:
        return
    if is_invertible(np.reshape(pose, (4, 4))) and pose[12:] == IDENTITY[12:]:
        return
    raise CubicCraftError(
        f'the pose of the handle "{handle.group}" of "{obj.name}" is not an affine map, or has a'
        " scale of zero; click Reset Pose, or give it as a mathutils.Matrix (Blender takes a plain"
        " list by its columns)"
    )


def set_own_pose(handle: CubicCraftHandle, pose: Pose) -> None:
    """Store a pose with the handle."""
    handle.pose = Matrix(np.reshape(pose, (4, 4)).tolist())


def identify(handle: CubicCraftHandle) -> int:
    """Return a number that identifies the handle on its object, whatever its place in the list."""
    if not handle.uid:
        handle.uid = random.randrange(1, 2**31)
    return handle.uid


def keep_poses(obj: bpy.types.Object, poses: Mapping[int, Pose]) -> None:
    """Store poses, by the numbers of `identify`, with the object's handles."""
    for handle in object_properties(obj).handles:
        if handle.uid in poses:
            set_own_pose(handle, poses[handle.uid])
