# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect of moving, rotating and scaling a handle in the world on its pose. Without Blender.

The handle's vertices are where W P v is, with W the matrix of the object in the world and P the
pose. A motion D of the world changes it to P' = W^-1 D W P. The location of W cancels out and is
omitted, so that a part far from the origin does not lose digits.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

SMALLEST_FACTOR = 0.01
"""minimum scale of a drag: a part without extent could not be scaled up again"""


@dataclass(frozen=True)
class Drag:
    """A drag since its start.

    Each method returns a pose, 16 single-precision numbers, row by row; without any motion,
    it is the pose at the start, bit for bit.
    """

    pose: tuple[float, ...]
    """P at the start"""
    linear: np.ndarray
    """(3,3) of W, invertible"""
    center: np.ndarray
    """(3,) of the handle at the start, in object space"""
    axes: np.ndarray
    """(3,3) orthonormal axes in the world for rotation and scale, as columns"""

    def moved(self, way: Sequence[float] | np.ndarray) -> tuple[float, ...]:
        """Move it by a vector (3,) of the world."""
        map_of_object = np.eye(4)
        map_of_object[:3, 3] = np.linalg.solve(self.linear, np.asarray(way, dtype=np.float64))
        return self._after(map_of_object)

    def turned(self, axis: Sequence[float] | np.ndarray, angle: float) -> tuple[float, ...]:
        """Turn it about a unit vector (3,) of the world, in radians, counterclockwise."""
        x, y, z = axis
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        return self._about_center(
            np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
        )

    def scaled(self, factors: Sequence[float]) -> tuple[float, ...]:
        """Scale it along its axes."""
        sizes = np.maximum(factors, SMALLEST_FACTOR)
        return self._about_center(self.axes @ np.diag(sizes) @ self.axes.T)

    def _about_center(self, linear):
        if np.array_equal(linear, np.eye(3)):
            return self.pose
        map_of_object = np.eye(4)
        map_of_object[:3, :3] = np.linalg.solve(self.linear, linear @ self.linear)
        map_of_object[:3, 3] = self.center - map_of_object[:3, :3] @ self.center
        return self._after(map_of_object)

    def _after(self, map_of_object):
        if np.array_equal(map_of_object, np.eye(4)):
            return self.pose
        pose = (map_of_object @ np.reshape(self.pose, (4, 4))).astype(np.float32)
        return tuple(pose.astype(np.float64).ravel().tolist())
