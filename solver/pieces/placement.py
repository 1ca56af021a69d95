# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an object is solved, and what its surface is turned toward there."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import FloatArray
from ..rotation_fit import svd_rotations
from ..styles.style import Style
from ..surface.symmetry import Mirror


@dataclass(frozen=True, eq=False)
class Placement:
    """The map p = A v + t into the coordinates in which an object is solved, and its styles there.

    An object that is solved alone is solved in its own coordinates, stretched by its scale, which
    do not change while it is moved or rotated. Objects that are solved together share those of the
    world.
    """

    linear: FloatArray
    """(3,3) A, invertible"""
    offset: FloatArray
    """(3,) t"""
    turn: FloatArray
    """(3,3) rotation or mirroring T of A = T S"""
    stretch: FloatArray
    """(3,3) symmetric stretch S of A = T S, up to rounding"""
    up: FloatArray
    """(3,) unit vector that points up in the world"""
    styles: tuple[Style, ...]
    """of the object itself and of each of its regions. Each orientation maps these coordinates into
    the form's frame; for a cube it is one of the 24 that are the same, else of a mirrored object a
    reflection"""

    @property
    def style(self) -> Style:
        """The style of the object itself."""
        return self.styles[0]

    @property
    def is_mirrored(self) -> bool:
        """Whether triangles are flipped there."""
        return bool(np.linalg.det(self.linear) < 0.0)

    @property
    def key(self) -> tuple[Any, ...]:
        """All values but the cubeness and strengths, for comparison bit for bit."""
        shape = self.shape_key
        own, *regions = (
            (
                shape,
                np.asarray(style.orientation).tobytes(),
                tuple(form.key for form in style.forms),
            )
            for style in self.styles
        )
        return own, *((region,) for region in regions)

    @property
    def shape_key(self) -> tuple[bytes, bytes]:
        """All values that determine the positions of the vertices."""
        return self.linear.tobytes(), self.offset.tobytes()

    @property
    def matrix(self) -> FloatArray:
        """(4,4) of p = A v + t."""
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = self.linear, self.offset
        return matrix

    def place(self, points: FloatArray) -> FloatArray:
        """Return float64 points (n,3) in the coordinates in which the object is solved."""
        placed = points.astype(np.float64) @ self.linear.T
        return placed + self.offset if self.offset.any() else placed

    def read_back(self, placed: FloatArray) -> FloatArray:
        """Return points from `place`, possibly moved, in object coordinates."""
        centerd = placed - self.offset if self.offset.any() else placed
        return centerd @ np.linalg.inv(self.linear).T

    def mirror(self, mirror: Mirror) -> Mirror:
        """Return a Mirror of object coordinates in those in which the object is solved."""
        linear = self.linear @ mirror.linear @ np.linalg.inv(self.linear)
        offset = self.linear @ mirror.offset + self.offset - linear @ self.offset
        return type(mirror)(mirror.partner, linear, offset)

    def read_rotations_back(self, rotations: FloatArray) -> FloatArray:
        """Return the rotations (n,3,3) around vertices in object coordinates.

        With non-uniform scale, they are the nearest rotations to the deformation around each
        vertex; they rotate the offsets of shape keys and must not distort them.
        """
        if not np.array_equal(self.turn, np.eye(3)):
            rotations = self.turn.T @ rotations @ self.turn
        stretch = self.stretch
        if np.allclose(stretch, stretch[0, 0] * np.eye(3), rtol=1e-6, atol=0.0):
            return rotations
        maps = np.linalg.inv(stretch) @ rotations @ stretch
        return svd_rotations(maps.swapaxes(1, 2))


def placement_by(matrix: ArrayLike, styles: tuple[Style, ...]) -> Placement:
    """Return the Placement of an object in the world.

    `matrix`: (4,4), from the object's coordinates to those of the world; its linear part is
    invertible. `styles`: of the object and of each of its regions, with orientations of the world.
    """
    matrix = np.asarray(matrix, dtype=np.float64)
    linear, offset = np.ascontiguousarray(matrix[:3, :3]), matrix[:3, 3].copy()
    turn, stretch = polar(linear)
    up = np.array([0.0, 0.0, 1.0])
    return Placement(linear, offset, turn, stretch, up, styles)


def polar(linear: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the rotation or mirroring T and the symmetric stretch S of A = T S, (3,3) each."""
    U, sizes, Vt = np.linalg.svd(linear)
    turn = np.asarray(U @ Vt, dtype=np.float64)
    return turn, np.asarray(Vt.T @ np.diag(sizes) @ Vt, dtype=np.float64)
