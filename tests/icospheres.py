# SPDX-License-Identifier: GPL-3.0-or-later
"""Round shapes of any fineness, whose vertices lie regularly.

All return V (n,3) and F (m,3).
"""

import numpy as np

GOLDEN = (1 + 5**0.5) / 2
ICOSAHEDRON = np.array(
    [
        *[(-1, GOLDEN, 0), (1, GOLDEN, 0), (-1, -GOLDEN, 0), (1, -GOLDEN, 0)],
        *[(0, -1, GOLDEN), (0, 1, GOLDEN), (0, -1, -GOLDEN), (0, 1, -GOLDEN)],
        *[(GOLDEN, 0, -1), (GOLDEN, 0, 1), (-GOLDEN, 0, -1), (-GOLDEN, 0, 1)],
    ]
)
_FACES = (
    "0 11 5 0 5 1 0 1 7 0 7 10 0 10 11 1 5 9 5 11 4 11 10 2 10 7 6 7 1 8"
    " 3 9 4 3 4 2 3 2 6 3 6 8 3 8 9 4 9 5 2 4 11 6 2 10 8 6 7 9 8 1"
)
ICOSAHEDRON_FACES = np.array(_FACES.split(), int).reshape(-1, 3)


def subdivided(V, F):
    """Split each triangle in four."""
    sides = np.sort(np.concatenate([F[:, [1, 2]], F[:, [2, 0]], F[:, [0, 1]]]), axis=1)
    edges, number = np.unique(sides, axis=0, return_inverse=True)
    a, b, c = len(V) + number.reshape(3, -1)  # a is opposite corner 0
    i, j, k = F.T
    quarters = [(i, c, b), (j, a, c), (k, b, a), (a, b, c)]
    F = np.concatenate([np.stack(quarter, axis=1) for quarter in quarters])
    return np.concatenate([V, V[edges].mean(axis=1)]), F


def bumpy(V):
    """Return points of the unit sphere moved onto an asymmetric bumpy shape."""
    x, y, z = V.T
    radius = 1 + 0.3 * np.sin(3 * x + 0.4) * np.cos(2 * y) + 0.15 * np.sin(5 * z + y)
    return V * radius[:, None] * [1.0, 0.8, 1.3]


def ball(subdivisions):
    """Return a unit sphere; n = 10 * 4 ** subdivisions + 2."""
    V, F = _unit(ICOSAHEDRON), ICOSAHEDRON_FACES
    for _ in range(subdivisions):
        V, F = subdivided(V, F)
        V = _unit(V)
    return V, F


def blob(subdivisions):
    """Return a `ball` with bumps."""
    V, F = ball(subdivisions)
    return bumpy(V), F


def _unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
