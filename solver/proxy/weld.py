# SPDX-License-Identifier: GPL-3.0-or-later
"""Merge vertices at the same place, so that seams of a file are no borders of the surface."""

import numpy as np

from ..algebra import columns, dot
from ..mesh.components import components
from ..mesh.edges import Edges, distinct

TOLERANCE = 1e-6
"""of the largest extent; closer vertices are at the same place..."""
OF_EDGES = 0.01
"""...unless that is more than this share of the edges of the finest part: a ring in a landscape"""
_BITS = 21  # for each coordinate in a key; the tolerance of 1e-6 needs 20


def weld(V, F, part=None):
    """Return which vertices are merged, and the triangles between them.

    `V`: (n,3), positions in the unit box. `F`: (m,3) int, triangles. `part`: (n,) int, optional,
    connected part of each vertex. Returns `group`: (n,) int, index of the welded vertex of each, in
    the order of their first vertices; `first`: (w,) int, the first vertex of each. Parts that share
    only a vertex, not an edge, stay separate: an eye would hang on it as on a hinge; `F`: (k,3)
    int, triangles between welded vertices. Collapsed ones are removed, and of those with the same
    corners, only one is kept: otherwise the normals of a leaf modeled as two coincident sheets
    would cancel out.
    """
    tolerance = _tolerance(V, F, components(F, len(V))[1] if part is None else part)
    label = _joined(_least_of_cell(V / tolerance + 0.5), _least_of_cell(V / tolerance))
    is_first = label == np.arange(len(V))
    first = np.flatnonzero(is_first)
    if len(first) == len(V):
        return label, first, F
    group = _of_one_part(label, F)
    first = np.full(int(group.max()) + 1, len(V))
    np.minimum.at(first, group, np.arange(len(V)))
    return group, first, distinct(group[F].astype(F.dtype))


def _of_one_part(label, F):
    """Split vertices at one place by the parts that share edges; return new indices (n,)."""
    one, other = Edges(label[F], len(label)).triangles()
    # triangles that share an edge belong to one part, and so do those that shared a vertex before
    nodes = len(F) + len(label)
    at = np.stack([np.repeat(np.arange(len(F)), 3), len(F) + F.ravel()], axis=1)
    pairs = np.concatenate([np.stack([one, other], axis=1), at])
    _, part = components(pairs, nodes)
    key = label * nodes + part[len(F) :]
    _, first, group = np.unique(key, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[group.ravel()]


def _tolerance(V, F, part):
    side = columns(V).take(F[:, 1], axis=1) - columns(V).take(F[:, 0], axis=1)
    length, owner = np.sqrt(dot(*side, *side)), part[F[:, 0]]
    mean = np.bincount(owner, length) / np.maximum(np.bincount(owner), 1)
    return min(TOLERANCE, OF_EDGES * mean[mean > 1e-12].min(initial=1.0))


def _least_of_cell(V):
    """Return the first vertex (n,) in the same cell of a grid of width 1."""
    x, y, z = np.floor(V.T).astype(np.int64)
    if max(x.max(), y.max(), z.max()) < 1 << _BITS:
        key = (x << 2 * _BITS) | (y << _BITS) | z
        _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
    else:
        cells = np.column_stack([x, y, z])
        _, first, inverse = np.unique(cells, axis=0, return_index=True, return_inverse=True)
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
