# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of any fineness, made of NumPy alone: for those who do not have the usual meshes.

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
CLOTHED = (-0.3, 0.4)
"""from where to where a body wears its shirt; its height is about 3"""
SHIRT_GAP = 0.008
"""between a body and its shirt, of the height"""
BALL = 0.2
"""radius of what is stuck to the character"""


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


def sphere(segments, rings):
    """Return a sphere of meridians and parallels, with triangles at both poles."""
    angles = np.linspace(0, np.pi, rings + 1), np.arange(segments) * (2 * np.pi / segments)
    polar, around = np.meshgrid(*angles, indexing="ij")
    V = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)])
    here = np.arange(polar.size).reshape(polar.shape)
    here[0], here[-1] = 0, here[-1, 0]
    a, b, c, d = here[:-1], here[1:], np.roll(here[1:], -1, 1), np.roll(here[:-1], -1, 1)
    halves = (a[1:], b[1:], d[1:]), (b[:-1], c[:-1], d[:-1])  # none without area at a pole
    F = np.concatenate([np.stack(half, axis=-1).reshape(-1, 3) for half in halves])
    used, F = np.unique(F, return_inverse=True)
    return V.reshape(3, -1).T[used], F.reshape(-1, 3)


def character(subdivisions):
    """Return a blob with twelve balls that touch it, each a part of its own."""
    V, F = blob(subdivisions)
    parts = [(V, F)]
    for at in V[:12]:  # the corners of the icosahedron lie all around
        ball, triangles = blob(subdivisions - 3)
        parts.append((BALL * _unit(ball) + at + BALL * _unit(at), triangles))
    return _joined(parts)


def dressed_body(subdivisions):
    """Return a blob with a copy of its middle around it, like a shirt."""
    V, F = blob(subdivisions)
    a, b, c = (V[corner] for corner in F.T)
    normals = np.zeros_like(V)
    for corner in F.T:
        np.add.at(normals, corner, np.cross(b - a, c - a))
    height = V[F, 2].mean(axis=1)
    clothed = F[(height > CLOTHED[0]) & (height < CLOTHED[1])]
    used, triangles = np.unique(clothed, return_inverse=True)
    shirt = V[used] + SHIRT_GAP * np.ptp(V[:, 2]) * _unit(normals[used])
    return _joined([(V, F), (shirt, triangles.reshape(-1, 3))])


def _unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def _joined(parts):
    offsets = np.cumsum([0, *(len(V) for V, _ in parts)])[:-1]
    V = np.concatenate([V for V, _ in parts])
    return V, np.concatenate([F + k for (_, F), k in zip(parts, offsets, strict=True)])
