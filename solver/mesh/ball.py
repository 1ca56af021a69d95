# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball, to try things on."""

import numpy as np

from ..aliases import FloatArray, IntArray
from ..inputs import whole_number


def ball(vertices: int = 700) -> tuple[FloatArray, IntArray]:
    """Return a ball of radius 1 about the origin, whose vertices are evenly spread.

    Positions, from the lowest along Z to the highest, and triangles, which face outward; of 4
    vertices at least.

    Raises
    ------
    CubicCraftError
        There are fewer than 4 vertices.

    Examples
    --------
    >>> from solver import ball
    >>> V, F = ball(100)
    >>> V.shape, F.shape
    ((100, 3), (196, 3))
    """
    from scipy.spatial import ConvexHull

    count = whole_number(vertices, "vertices", 4)
    z, angle = np.linspace(-1, 1, count), 2.4 * np.arange(count)  # about the golden angle
    V = np.stack([*(np.sqrt(1 - z**2) * [np.cos(angle), np.sin(angle)]), z], axis=1)
    F = ConvexHull(V).simplices
    is_outward = np.linalg.det(V[F]) > 0
    return V, np.where(is_outward[:, None], F, F[:, ::-1])
