# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose vertices evenly over a surface, each to represent the area around it."""

import numpy as np

PER_PART = 12
"""minimum cells along the largest extent of a part: small parts of a scene have links, too"""


def surface_samples(V, normals, areas, part, is_candidate, count):
    """Return about `count` vertices, or all of them if there are no more.

    One is taken from each cell of a grid and each direction that the surface faces there, so that
    both sides of a thin wall have their own. Parts have separate samples.

    `V`, `normals`: (n,3). `areas`: (n,). `part`: (n,) int. `is_candidate`: (n,) bool. Returns
    `spacing`: (n,), distance of neighbors, at each vertex; `chosen`: (k,) int, vertices; `area`:
    (k,), the area that each represents.
    """
    rows = np.flatnonzero(is_candidate)
    spacing = np.sqrt(areas[rows].sum() / max(min(count, len(rows)), 1))
    spacing = np.minimum(spacing, extents(V, part) / PER_PART)
    spacing = np.maximum(spacing, 1e-9)[part]
    if len(rows) <= count:
        return spacing, rows, areas[rows]
    cell = np.floor(V[rows] / spacing[rows, None]).astype(np.int64)
    axis = np.abs(normals[rows]).argmax(axis=1)
    facing = 2 * axis + (normals[rows, axis] > 0.0)
    order = np.lexsort((facing, *cell.T, part[rows]))
    sorted_keys = np.column_stack([part[rows], cell, facing])[order]
    is_first = np.ones(len(rows), dtype=bool)
    is_first[1:] = (sorted_keys[1:] != sorted_keys[:-1]).any(axis=1)
    starts = np.flatnonzero(is_first)
    return spacing, rows[order[starts]], np.add.reduceat(areas[rows][order], starts)


def extents(V, part):
    """Return the largest extent (p,) of each part; none is without vertices."""
    order = np.argsort(part, kind="stable")
    starts = np.flatnonzero(np.diff(part[order], prepend=-1))
    sides = [
        np.maximum.reduceat(x, starts) - np.minimum.reduceat(x, starts) for x in V[order].T.copy()
    ]
    return np.max(sides, axis=0)
