# SPDX-License-Identifier: GPL-3.0-or-later
"""Which triangles share an edge."""

import numpy as np


def faces_at_edges(F, n):
    """Return pairs (k,) and (k,) of triangles that have an edge in common.

    F : (m,3) int array
        Triangles between n vertices. Edges from a vertex to itself are no edges; of more than two
        triangles at one edge, each is paired with the next.
    """
    start, end = F.astype(np.int64).ravel(), F[:, [1, 2, 0]].astype(np.int64).ravel()
    key = np.minimum(start, end) * n + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    is_same = (ordered[1:] == ordered[:-1]) & (start != end)[order][1:]
    return order[:-1][is_same] // 3, order[1:][is_same] // 3
