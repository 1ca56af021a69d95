# SPDX-License-Identifier: GPL-3.0-or-later
"""Bumpy spheres of any fineness, for those who do not have the usual meshes."""

import numpy as np

_GOLDEN = (1 + 5**0.5) / 2
_ICOSAHEDRON = np.array(
    [
        *[(-1, _GOLDEN, 0), (1, _GOLDEN, 0), (-1, -_GOLDEN, 0), (1, -_GOLDEN, 0)],
        *[(0, -1, _GOLDEN), (0, 1, _GOLDEN), (0, -1, -_GOLDEN), (0, 1, -_GOLDEN)],
        *[(_GOLDEN, 0, -1), (_GOLDEN, 0, 1), (-_GOLDEN, 0, -1), (-_GOLDEN, 0, 1)],
    ]
)
_FACES = (
    "0 11 5 0 5 1 0 1 7 0 7 10 0 10 11 1 5 9 5 11 4 11 10 2 10 7 6 7 1 8"
    " 3 9 4 3 4 2 3 2 6 3 6 8 3 8 9 4 9 5 2 4 11 6 2 10 8 6 7 9 8 1"
)


def blob(subdivisions):
    """Return V (n,3) and F (m,3) of a sphere with bumps; n = 10 * 4 ** subdivisions + 2.

    Each subdivision splits every triangle in four and projects the new vertices onto the sphere.
    """
    V = _ICOSAHEDRON / np.linalg.norm(_ICOSAHEDRON[0])
    F = np.array(_FACES.split(), dtype=np.int64).reshape(-1, 3)
    for _ in range(subdivisions):
        V, F = _subdivided(V, F)
        V /= np.linalg.norm(V, axis=1, keepdims=True)
    x, y, z = V.T
    radius = 1 + 0.3 * np.sin(3 * x + 0.4) * np.cos(2 * y) + 0.15 * np.sin(5 * z + y)
    return V * radius[:, None] * [1.0, 0.8, 1.3], F


def _subdivided(V, F):
    sides = np.sort(np.concatenate([F[:, [1, 2]], F[:, [2, 0]], F[:, [0, 1]]]), axis=1)
    edges, number = np.unique(sides, axis=0, return_inverse=True)
    i, j, k = F.T
    a, b, c = len(V) + number.reshape(3, -1)  # the middles of the sides opposite i, j and k
    quarters = [(i, c, b), (j, a, c), (k, b, a), (a, b, c)]
    F = np.concatenate([np.stack(quarter, axis=1) for quarter in quarters])
    return np.concatenate([V, V[edges].mean(axis=1)]), F
