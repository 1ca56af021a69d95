# SPDX-License-Identifier: GPL-3.0-or-later
"""Split long edges, so that a coarse surface can bend."""

import numpy as np

from ..cotangents import cotangents
from .creases import mute_edges
from .edges import edges_of
from .samples import extents

FINENESS = 40
"""edges along the largest extent of a part"""
FINEST = 1000
"""edges along the largest extent of all; smaller parts are not split further"""
BUDGET = 8000
"""largest number of vertices after splitting,..."""
FOR_EACH_PART = 200
"""...plus this number for each of its parts,..."""
MOST = 16_000
"""...up to this number..."""
GROWTH = 1.2
"""...or this multiple of its own, if that is more"""
OVERDRAFT = 1.5
"""multiple of the budget, at most, with the vertices of narrow sides"""
_STEP = 0.6  # of the longest edge, relative to its bound: a round splits longer edges


def longest_edges(V, F, part):
    """Return the maximum edge length of each part, (p,).

    Parameters
    ----------
    V : (n,3) float array
        Positions in the unit box.
    F : (m,3) int array
    part : (n,) int array
        Part of each vertex.
    """
    return np.maximum(extents(V, part) / FINENESS, 1.0 / FINEST)


def refine(V, F, bound, parts=1):
    """Split edges at their midpoints until none is longer than its bound, or the budget is spent.

    At last a midpoint is put into narrow sides that have vertices in their creases only.

    Rounds split the longest first, so that a budget that is too small is spent evenly. With an edge
    of a triangle its longest one is split, too (Rivara, "Algorithms for refining triangular grids",
    1984), which keeps triangles from becoming needles; neighbours share midpoints, so the surface
    stays closed.

    Parameters
    ----------
    V : (n,3) float array
    F : (m,3) int array
    bound : (n,) float array
        How long edges may be, at each vertex; the same within a part.
    parts : int
        How many of them there are.

    Returns
    -------
    V : (n+k,3) float array
        The given positions, then those of midpoints.
    F : (l,3) int array
    parents : (k,2) int array
        Ends of the edge that each midpoint halves.
    rounds : (r+1,) int array
        Where in `parents` each round begins, and the end.
    """
    budget = max(min(BUDGET + FOR_EACH_PART * (parts - 1), MOST), int(GROWTH * len(V)))
    parents, rounds = [np.empty((0, 2), np.int64)], [0]
    F, bound = F.astype(np.int64), bound.astype(np.float64)
    is_fine = False
    while not is_fine:
        edges, edge_of, ratio = _edges(V, F, bound)
        is_fine, is_split = _to_be_split(V, F, edge_of, ratio, len(edges))
        if len(V) + np.count_nonzero(is_split) > budget:
            is_fine, is_split = True, _mute(V, F, edge_of, len(edges))
        if is_fine and len(V) + np.count_nonzero(is_split) > OVERDRAFT * budget:
            break
        new = edges[is_split]
        number = np.full(len(edges), -1)
        number[is_split] = len(V) + np.arange(len(new))
        V = np.concatenate([V, 0.5 * (V[new[:, 0]] + V[new[:, 1]])])
        bound = np.concatenate([bound, bound[new[:, 0]]])
        F = _split(F, number[edge_of], ratio[edge_of])
        parents.append(new)
        rounds.append(rounds[-1] + len(new))
    return V, F.astype(np.int32), np.concatenate(parents), np.array(rounds)


def _to_be_split(V, F, edge_of, ratio, count):
    """Return whether this is the last round, and the edges to be split in it."""
    longest = ratio.max(initial=0.0)
    if longest > 1.0:
        return False, _closed(ratio > max(1.0, _STEP * longest), ratio, edge_of)
    return True, _mute(V, F, edge_of, count)


def _mute(V, F, edge_of, count):
    return mute_edges(V, F, cotangents(V, F), edge_of, count)


def _edges(V, F, bound):
    """Return edges (e,2), the edge (m,3) opposite each corner, and lengths (e,) in their bounds."""
    edges, number = edges_of(F[:, [1, 2, 0]].ravel(), F[:, [2, 0, 1]].ravel(), len(V))
    length = np.linalg.norm(V[edges[:, 1]] - V[edges[:, 0]], axis=1)
    return edges, number.reshape(F.shape), length / bound[edges[:, 0]]


def _closed(is_split, ratio, edge_of):
    """Mark the longest edge of each triangle to be split if any of its edges is."""
    longest = edge_of[np.arange(len(edge_of)), ratio[edge_of].argmax(axis=1)]
    while True:
        wanted = longest[is_split[edge_of].any(axis=1)]
        if is_split[wanted].all():
            return is_split
        is_split[wanted] = True


def _split(F, middle, length):
    """Replace triangles by two, three or four.

    Parameters
    ----------
    F : (m,3) int array
    middle : (m,3) int array
        Midpoint of the edge opposite each corner, or -1.
    length : (m,3) array
        Of those edges.
    """
    # the corner opposite the longest edge that is split comes first
    turn = (np.where(middle >= 0, length, -1.0).argmax(axis=1)[:, None] + np.arange(3)) % 3
    rows = np.arange(len(F))[:, None]
    (a, b, c), (p, q, r) = F[rows, turn].T, middle[rows, turn].T
    parts = []

    def add(where, *corners):
        parts.append(np.stack([corner[where] for corner in corners], axis=1))

    has_q, has_r = q >= 0, r >= 0
    whole = p < 0
    add(whole, a, b, c)
    left, right = ~whole & ~has_r, ~whole & ~has_q
    add(left, a, b, p)
    add(right, a, p, c)
    left, right = ~whole & has_r, ~whole & has_q
    add(left, a, r, p)
    add(left, r, b, p)
    add(right, a, p, q)
    add(right, q, p, c)
    return np.concatenate(parts)
