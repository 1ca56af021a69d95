# SPDX-License-Identifier: GPL-3.0-or-later
"""Split long edges, so that a coarse surface can bend."""

import numpy as np

from ..mesh.edge_vectors import edge_vectors
from ..mesh.edges import edges_of
from .creases import mute_sides
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


def longest_edges(V, part):
    """Return the maximum edge length (p,) of each part of V (n,3), in the unit box."""
    return np.maximum(extents(V, part) / FINENESS, 1.0 / FINEST)


def refine(V, F, bound, parts=1):
    """Split edges at their midpoints until none is longer than its bound, or the budget is spent.

    At last a midpoint is put into narrow sides that have vertices in their creases only.

    Rounds split the longest first, so that a budget that is too small is spent evenly. As a round
    splits all edges beyond a length, it splits the longest one of each triangle of which it splits
    any (Rivara, "Algorithms for refining triangular grids", 1984), which keeps triangles from
    becoming needles; neighbors share midpoints, so the surface stays closed.

    `V`: (n,3). `F`: (m,3) int. `bound`: (n,), how long edges may be, at each vertex; the same
    within a part. `parts`: int, how many of them there are. Returns `V`: (n+k,3), the given
    positions, then those of midpoints; `F`: (l,3) int; `parents`: (k,2) int, ends of the edge that
    each midpoint halves; `rounds`: (r+1,) int, where in `parents` each round begins, and the end;
    `whole`: (l,) int, the given triangle that each one is a piece of.
    """
    budget = max(min(BUDGET + FOR_EACH_PART * (parts - 1), MOST), int(GROWTH * len(V)))
    parents, rounds = [np.empty((0, 2), np.int64)], [0]
    F, bound = F.astype(np.int64), bound.astype(np.float64)
    whole = np.arange(len(F))
    ratio = _ratios(V, F, bound)
    is_fine = False
    while not is_fine:
        longest = ratio.max(initial=0.0)
        rows, new, middle = _midpoints(F, ratio > max(1.0, _STEP * longest), len(V))
        is_fine = not len(new) or len(V) + len(new) > budget
        if is_fine:
            rows, new, middle = _midpoints(F, mute_sides(V, F), len(V))
            if len(V) + len(new) > OVERDRAFT * budget:
                break
        V = np.concatenate([V, 0.5 * (V[new[:, 0]] + V[new[:, 1]])])
        bound = np.concatenate([bound, bound[new[:, 0]]])
        pieces, of_row = _split(F[rows], middle, ratio[rows])
        F = np.concatenate([F[~rows], pieces])
        whole = np.concatenate([whole[~rows], whole[rows][of_row]])
        ratio = np.concatenate([ratio[~rows], _ratios(V, pieces, bound)])
        parents.append(new)
        rounds.append(rounds[-1] + len(new))
    return V, F.astype(np.int32), np.concatenate(parents), np.array(rounds), whole


def _ratios(V, F, bound):
    lengths = np.empty(F.shape)
    for block, sides in edge_vectors(V, F):
        lengths[block] = np.sqrt((sides * sides).sum(axis=1)).T
    return lengths / bound[F[:, :1]]


def _midpoints(F, is_split, n):
    """Return the midpoints of the sides (m,3) to be split, numbered from n on.

    Only triangles with such a side are looked at: most of a fine mesh has none.

    Returns `rows`: (m,) bool, the k triangles that have such sides; `new`: (p,2) int, ends of the
    edges that are split, in ascending order; `middle`: (k,3) int, midpoint of the side opposite
    each corner, or -1.
    """
    rows = is_split[:, 0] | is_split[:, 1] | is_split[:, 2]  # `any` takes four times as long
    sides, is_split = F[rows], is_split[rows].ravel()
    start, end = sides[:, [1, 2, 0]].ravel(), sides[:, [2, 0, 1]].ravel()
    new, number = edges_of(start[is_split], end[is_split], n)
    middle = np.full(len(start), -1)
    middle[is_split] = n + number
    return rows, new, middle.reshape(sides.shape)


def _split(F, middle, length):
    """Replace triangles, each of which has at least one midpoint, by two, three or four.

    `F`: (m,3) int. `middle`: (m,3) int, midpoint of the edge opposite each corner, or -1. `length`:
    (m,3), of those edges. Returns (l,3) int; (l,) int, the row of F that each is a piece of.
    """
    # the corner opposite the longest edge that is split comes first
    turn = (np.where(middle >= 0, length, -1.0).argmax(axis=1)[:, None] + np.arange(3)) % 3
    rows = np.arange(len(F))[:, None]
    (a, b, c), (p, q, r) = F[rows, turn].T, middle[rows, turn].T
    parts, of_row = [], []

    def add(where, *corners):
        parts.append(np.stack([corner[where] for corner in corners], axis=1))
        of_row.append(np.flatnonzero(where))

    has_q, has_r = q >= 0, r >= 0
    add(~has_r, a, b, p)
    add(~has_q, a, p, c)
    add(has_r, a, r, p)
    add(has_r, r, b, p)
    add(has_q, a, p, q)
    add(has_q, q, p, c)
    return np.concatenate(parts), np.concatenate(of_row)
