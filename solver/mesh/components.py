# SPDX-License-Identifier: GPL-3.0-or-later
"""Connected components: parts that share no triangle and are not linked."""

import numpy as np


def components(F, n, pairs=None):
    """Return the number of components and the component of each vertex, ``(n,)`` int32.

    Components are numbered by their first vertex.

    F : (m,3) int array of triangles. A vertex in no triangle is a component of its own.
    pairs : (p,2) int array of further connections, optional.

    Vertices carry the number of a vertex of their component. Each round hangs every number below
    its least neighbor, follows the chains to their ends, and forgets the edges that have become
    inner ones (Liu and Tarjan, "Simple Concurrent Labeling Algorithms for Connected Components",
    2019). In whole arrays that is as fast as SciPy's search, whose import takes longer than the
    whole set-up of a small mesh.
    """
    label = np.arange(n)
    corners = F.astype(label.dtype)  # unless all are of one type, minimum.at is slow
    a, b = corners[:, :2].ravel(), corners[:, 1:].ravel()
    if pairs is not None:
        a, b = np.concatenate([a, pairs[:, 0]]), np.concatenate([b, pairs[:, 1]])
    while len(a):
        np.minimum.at(label, np.maximum(a, b), np.minimum(a, b))
        label = _ends(label)
        a, b = label[a], label[b]
        is_outer = a != b
        a, b = a[is_outer], b[is_outer]
    is_first = label == np.arange(n)
    number = np.cumsum(is_first, dtype=np.int32) - np.int32(1)
    return int(is_first.sum()), number[label]


def _ends(label):
    """Return the end of the chain label[label[...]] of each entry."""
    while True:
        ends = label[label]
        if np.array_equal(ends, label):
            return label
        label = ends
