# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose vertices evenly over a surface, each to stand for the area around it."""

import numpy as np


def surface_samples(V, normals, areas, part, is_candidate, count):
    """Return about `count` vertices, or all of them where there are no more.

    One of each cell of a grid is taken, and of each direction that the surface faces in it, so that
    both sides of a thin wall have their own.

    Parameters
    ----------
    V, normals : (n,3) float arrays
    areas : (n,) float array
    part : (n,) int array
        Parts have samples of their own.
    is_candidate : (n,) bool array

    Returns
    -------
    spacing : float
        Distance of neighbours.
    chosen : (k,) int array
        Vertices.
    area : (k,) array
        The area that each stands for.
    """
    rows = np.flatnonzero(is_candidate)
    spacing = float(np.sqrt(areas[rows].sum() / count))
    if len(rows) <= count or spacing <= 0.0:
        mean = float(np.sqrt(areas[rows].sum() / max(len(rows), 1)))
        return max(mean, 1e-12), rows, areas[rows]
    cell = np.floor(V[rows] / spacing).astype(np.int64)
    axis = np.abs(normals[rows]).argmax(axis=1)
    facing = 2 * axis + (normals[rows, axis] > 0.0)
    sizes = cell.max(axis=0) + 1
    key = (cell[:, 0] * sizes[1] + cell[:, 1]) * sizes[2] + cell[:, 2]
    key = (key * 6 + facing) * (int(part.max()) + 1) + part[rows]
    _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
    return spacing, rows[first], np.bincount(inverse.ravel(), areas[rows])
