# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes made in the tests, small and with every feature that matters to the solver."""

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


def subdivided(V, F):
    """Split each triangle in four."""
    edges = np.sort(np.concatenate([F[:, [1, 2]], F[:, [2, 0]], F[:, [0, 1]]]), axis=1)
    edges, number = np.unique(edges, axis=0, return_inverse=True)
    a, b, c = len(V) + number.reshape(3, -1)  # a is opposite corner 0
    i, j, k = F.T
    V = np.concatenate([V, V[edges].mean(axis=1)])
    return V, np.concatenate([np.stack(t, 1) for t in ((i, c, b), (j, a, c), (k, b, a), (a, b, c))])


def sphere(levels=3):
    """Return an icosphere of radius 1; 642 vertices at level 3."""
    V, F = _ICOSAHEDRON.astype(float), np.array(_FACES.split(), int).reshape(-1, 3)
    for _ in range(levels):
        V, F = subdivided(V, F)
    return V / np.linalg.norm(V, axis=1, keepdims=True), F


def blob(levels=3):
    """Return a bumpy, asymmetric closed shape."""
    V, F = sphere(levels)
    x, y, z = V.T
    radius = 1 + 0.3 * np.sin(3 * x + 0.4) * np.cos(2 * y) + 0.15 * np.sin(5 * z + y)
    return V * radius[:, None] * [1.0, 0.8, 1.3] + [0.2, -0.1, 0.4], F


def skewed_blob():
    """Return the blob with many obtuse triangles (negative weights)."""
    V, F = blob()
    return V * [1.0, 1.0, 0.15] + V[:, [2, 0, 1]] * [0.0, 0.0, 0.5], F


def sheet(n=12):
    """Return a wavy square with a boundary."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    V = np.stack([x, y, 0.2 * np.sin(4 * x) * np.cos(3 * y)], axis=-1).reshape(-1, 3)
    i = np.arange(n * n).reshape(n, n)
    a, b, c, d = i[:-1, :-1].ravel(), i[1:, :-1].ravel(), i[1:, 1:].ravel(), i[:-1, 1:].ravel()
    return V, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def two_blobs():
    """Return two components of different size, with a loose vertex between them."""
    (V, F), (W, G) = blob(2), skewed_blob()
    V = np.concatenate([V, [[5.0, 5.0, 5.0]], 0.4 * W + [4.0, 0.0, 1.0]])
    return V, np.concatenate([F, G + len(V) - len(W)])


def broken():
    """Return a blob with degenerate, duplicate and non-manifold triangles and a coincident pair."""
    V, F = blob(2)
    extra = np.array([[0, 0, 1], [2, 2, 2], F[3], F[3][::-1], [F[0][0], F[0][1], len(V)]])
    V = np.concatenate([V, [V[7]]])  # coincident with vertex 7, tied to F[0]'s edge by one triangle
    middle = (V[F[5][0]] + V[F[5][1]]) / 2
    V = np.concatenate([V, [middle]])
    flat = np.array([[F[5][0], F[5][1], len(V) - 1]])  # a triangle without area
    return V, np.concatenate([F, extra, flat])


ALL = {
    "sphere": sphere,
    "blob": blob,
    "skewed_blob": skewed_blob,
    "sheet": sheet,
    "two_blobs": two_blobs,
    "broken": broken,
}


def rotation(x=0.0, y=0.0, z=0.0):
    """Return the rotation about x, then y, then z, by degrees."""
    a, b, c = np.radians([x, y, z])
    X = [[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]]
    Y = [[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]]
    Z = [[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]]
    return np.array(Z) @ np.array(Y) @ np.array(X)


def extent(V):
    """Return the largest extent of the positions."""
    return float(np.ptp(V, axis=0).max())
