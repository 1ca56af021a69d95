# SPDX-License-Identifier: GPL-3.0-or-later
"""Make vertices at one place one, so that seams of a file are no borders of the surface."""

import numpy as np

TOLERANCE = 1e-6
"""of the largest extent; what is nearer is at one place"""
_BITS = 21  # for each coordinate in a key; the tolerance needs 20


def weld(V, F):
    """Return which vertices are one, and the triangles between them.

    Parameters
    ----------
    V : (n,3) float array
        Positions in the unit box.
    F : (m,3) int array
        Triangles.

    Returns
    -------
    group : (n,) int array
        Number of the welded vertex of each; they are numbered by their first vertex.
    first : (w,) int array
        The first vertex of each.
    F : (k,3) int array
        Triangles between welded vertices. Those that have collapsed are left out, and of those with
        the same corners one is left: else the normals of a leaf that was modelled as two coincident
        sheets would cancel out.
    """
    label = _joined(_least_of_cell(V, 0.5), _least_of_cell(V, 0.0))
    is_first = label == np.arange(len(V))
    first = np.flatnonzero(is_first)
    if len(first) == len(V):
        return label, first, F
    group = (np.cumsum(is_first) - 1)[label]
    return group, first, _distinct(group[F].astype(F.dtype), len(first))


def _least_of_cell(V, shift):
    """Return the first vertex (n,) in the same cell of a grid."""
    cell = np.floor(V / TOLERANCE + shift).astype(np.int64)
    key = (cell[:, 0] << 2 * _BITS) | (cell[:, 1] << _BITS) | cell[:, 2]
    _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
    return first[inverse.ravel()]


def _joined(one, other):
    """Join two partitions, each given by the first vertex (n,) of the set of each vertex.

    Vertices on either side of a border in one grid are in the same cell of the other one.
    """
    label = one
    while True:
        lower = label.copy()
        for partition in (other, one):
            least = lower.copy()
            np.minimum.at(least, partition, lower)
            lower = least[partition]
        if np.array_equal(lower, label):
            return label
        label = lower


def _distinct(F, n):
    """Return the triangles with three different corners, one of each set of corners."""
    F = F[(F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])]
    corners = np.sort(F.astype(np.int64), axis=1)
    order = np.lexsort(corners.T[::-1])
    ordered = corners[order]
    is_new = np.ones(len(F), dtype=bool)
    is_new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    return F[np.sort(order[is_new])]
