# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes made in the tests, small and with every feature that matters to the solver."""

import numpy as np

from tests.icospheres import ICOSAHEDRON, ICOSAHEDRON_FACES, bumpy, subdivided


def sphere(levels=3):
    """Return an icosphere of radius 1; 642 vertices at level 3."""
    V, F = ICOSAHEDRON, ICOSAHEDRON_FACES
    for _ in range(levels):
        V, F = subdivided(V, F)
    return V / np.linalg.norm(V, axis=1, keepdims=True), F


def blob(levels=3):
    """Return a bumpy, asymmetric closed shape."""
    V, F = sphere(levels)
    return bumpy(V) + [0.2, -0.1, 0.4], F


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


def squares(n):
    """Return a box of side 1 around the origin, with n x n squares on each side."""
    V, F = sheet(n + 1)
    flat = V * [1.0, 1.0, 0.0] - [0.5, 0.5, -0.5]
    turns = [rotation(), *(rotation(x=x) for x in (90, 180, -90)), rotation(y=90), rotation(y=-90)]
    points = np.round(np.concatenate([flat @ R.T for R in turns]), 9) + 0.0
    V, group = np.unique(points, axis=0, return_inverse=True)
    return V, np.concatenate([group.ravel()[F + number * len(flat)] for number in range(6)])


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
