# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges of triangles, and which triangles share them."""

import numpy as np

from ..spokes_and_rims import ordered_pairs


def edges_of(start, end, n):
    """Find which of many edges between n vertices are the same, in either direction.

    Parameters
    ----------
    start, end : (h,) int arrays

    Returns
    -------
    edges : (e,2) int array
        Each edge once, the lower end first, in ascending order.
    number : (h,) int array
        The index of each given edge among them.
    """
    lower, upper = np.minimum(start, end), np.maximum(start, end)
    order, is_new = ordered_pairs(lower, upper, n)
    number = np.empty(len(order), dtype=np.intp)
    number[order] = np.cumsum(is_new) - 1
    first = order[is_new]
    return np.stack([lower[first], upper[first]], axis=1), number


def faces_at_edges(F, n):
    """Return pairs (k,) and (k,) of triangles that have an edge in common.

    F : (m,3) int array
        Triangles between n vertices. Edges from a vertex to itself are ignored; if an edge has more
        than two triangles, each is paired with the next.
    """
    start, end = F.ravel(), F[:, [1, 2, 0]].ravel()
    order, is_new = ordered_pairs(np.minimum(start, end), np.maximum(start, end), n)
    is_same = ~is_new[1:] & (start != end)[order][1:]
    return order[:-1][is_same] // 3, order[1:][is_same] // 3
