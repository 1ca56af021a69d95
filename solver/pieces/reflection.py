# SPDX-License-Identifier: GPL-3.0-or-later
"""Reflections in the coordinates of an object."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..aliases import BoolArray, FloatArray, IntArray
from ..errors import CubicCraftError
from ..surface.symmetry import Mirror


@dataclass(frozen=True)
class Reflection:
    """A reflection x -> A x + b in object coordinates, as plain numbers; `flip` makes one.

    Examples
    --------
    >>> from solver import flip
    >>> flip(0).linear
    (-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    """

    linear: tuple[float, ...]
    """A, row by row"""
    offset: tuple[float, ...]
    """b"""
    tolerance: float
    """vertices at most this far from their image lie in the plane"""

    def mirror(self, partner: IntArray) -> Mirror:
        """Return it with the partners (n,) of the vertices."""
        return Mirror(partner, np.reshape(self.linear, (3, 3)), np.array(self.offset))

    @property
    def matrix(self) -> FloatArray:
        """The same as a matrix (4,4)."""
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = np.reshape(self.linear, (3, 3)), self.offset
        return matrix

    @property
    def normal(self) -> FloatArray:
        """(3,) unit normal of the plane."""
        return np.linalg.svd(np.eye(3) - np.reshape(self.linear, (3, 3)))[2][0]

    def image(self, points: FloatArray) -> FloatArray:
        """Return the reflected points (n,3)."""
        return points @ np.reshape(self.linear, (3, 3)).T + self.offset

    def is_in_plane(self, points: FloatArray, least: float) -> BoolArray:
        """Return which float64 points (n,3) are their own image, to its tolerance or `least`."""
        apart = np.linalg.norm(self.image(points) - points, axis=1)
        return apart <= max(self.tolerance, least)

    def is_like(self, other: Reflection) -> bool:
        """Return whether both are the same reflection."""
        return np.allclose(self.linear + self.offset, other.linear + other.offset)

    def commutes_with(self, other: Reflection) -> bool:
        """Return whether the order of both does not matter."""
        points = np.vstack([np.zeros(3), np.eye(3)])
        size = 1.0 + np.abs(self.offset).max() + np.abs(other.offset).max()
        apart = self.image(other.image(points)) - other.image(self.image(points))
        return bool(np.abs(apart).max() <= 1e-5 * size)

    def placed(self, place: FloatArray, tolerance: float) -> Reflection:
        """Return it in other coordinates, by their matrix (4,4), with a tolerance."""
        if np.array_equal(place, np.eye(4)):
            return Reflection(self.linear, self.offset, tolerance)
        matrix = np.eye(4)
        matrix[:3, :3] = np.reshape(self.linear, (3, 3))
        matrix = place @ matrix @ np.linalg.inv(place)
        offset = tuple(matrix[:3, 3].tolist())
        return Reflection(tuple(matrix[:3, :3].ravel().tolist()), offset, tolerance)


def flip(axis: int) -> Reflection:
    """Return the reflection along an axis of the object, 0, 1 or 2, about its origin.

    Raises
    ------
    CubicCraftError
        The axis is none of 0, 1 and 2.

    Examples
    --------
    >>> from solver import flip
    >>> flip(2).normal.round(2).tolist()
    [0.0, 0.0, 1.0]
    """
    if axis not in (0, 1, 2):
        raise CubicCraftError(f"an axis must be 0, 1 or 2, not {axis!r}")
    linear = np.eye(3)
    linear[axis, axis] = -1.0
    return Reflection(tuple(linear.ravel().tolist()), (0.0, 0.0, 0.0), 0.0)
