# SPDX-License-Identifier: GPL-3.0-or-later
"""The borders of sides, straight whatever the triangles are like.

A border of two sides runs along edges of triangles, in a zigzag where they lie aslant, and what is
left of it in the hard shape looks like teeth. So the vertices between are smoothed along the
border, and only what is short against it goes: steps forward and backward by turns keep what is
longer (Taubin, "A Signal Processing Approach to Fair Surface Design", 1995). Vertices stay where
three sides meet, or one ends, and where triangles would become slivers or cross.
"""

import numpy as np
import scipy.sparse as sp

from .new_crossings import NewCrossings

STEPS = 30
FORWARD, BACKWARD = 0.5, -0.53
"""shares of the way to the point between the neighbors"""
REACH = 0.9
"""of the edges beside it: how far a vertex may move"""
LEAST = 0.2
"""of what is seen of a face along its side, which stays"""
OVERLAP = 0.02
"""of the same: a triangle of it may be inside out by so much, as where three of its corners come to
lie on a line"""
_ROUNDS = 4  # of moving less
_SHORTEST = 1e-12


def straightening(
    U, F, graph, side, directions, fixed, *, farthest=np.inf, faces=None, may_cross=False
):
    """Return how far vertices (n,3) have to move so that the borders of sides are straight.

    Parameters
    ----------
    U, F : arrays
        Positions (n,3) of the hard shape, and triangles (m,3).
    graph : FaceGraph
        Of these.
    side : (m,) int array
        Of the triangles, negative for those without.
    directions : (m,3) array
        That the sides face.
    fixed : (k,) int array
        Vertices that stay.
    farthest : (n,) array, optional
        Vertices that would have to move farther are corners of a border, such as the end of a
        ridge, and stay.
    faces : (m,) int array, optional
        The polygon that each triangle is a piece of.
    may_cross : bool
        Whether not to look for what comes to cross, which takes long.
    """
    at, neighbors = _between(graph, side, fixed, len(U))
    moves = np.zeros_like(U)
    if not len(at):
        return moves
    moves[at] = _along(U, at, neighbors)
    is_corner = (np.linalg.norm(moves, axis=1) > farthest)[at]
    if is_corner.any():
        moves[at], at, neighbors = 0.0, at[~is_corner], neighbors[~is_corner]
        if not len(at):
            return moves
        moves[at] = _along(U, at, neighbors)
    is_moved = np.zeros(len(U), dtype=bool)
    is_moved[at] = True
    beside = is_moved[F].any(axis=1)
    sided = np.flatnonzero(beside & (side >= 0))
    of_triangles = np.arange(len(F)) if faces is None else faces
    _, polygon = np.unique(of_triangles[sided], return_inverse=True)
    _, whole = _seen(U, F[sided], directions[sided], polygon)
    crossings = None if may_cross else NewCrossings(U, U + moves, F, beside, faces)
    for number in range(_ROUNDS):
        X = U + moves
        own, of_polygon = _seen(X, F[sided], directions[sided], polygon)
        thin = sided[(of_polygon < LEAST * whole) | (own < -OVERLAP * whole)]
        bad = thin if crossings is None else np.concatenate([thin, crossings.at(X)])
        if not len(bad):
            break
        moves[F[bad]] *= 0.5 if number < _ROUNDS - 2 else 0.0
    return moves


def _between(graph, side, fixed, n):
    """Return the vertices (b,) along borders of two sides, and both neighbors (b,2) of each."""
    one, other = side[graph.one], side[graph.other]
    is_border, edge = one != other, graph.edge
    ends = np.stack([graph.edges.lower[edge], graph.edges.upper[edge]], axis=1)[is_border]
    is_sharp = np.minimum(one, other)[is_border] >= 0
    is_between = np.bincount(ends.ravel(), minlength=n) == 2
    is_between &= np.bincount(ends[is_sharp].ravel(), minlength=n) == 2
    is_between[fixed] = False
    start, end = np.concatenate([ends, ends[:, ::-1]]).T
    rows = np.flatnonzero(is_between[start])
    rows = rows[np.argsort(start[rows], kind="stable")]
    return np.flatnonzero(is_between), end[rows].reshape(-1, 2)


def _along(U, at, neighbors):
    """Return the moves (b,3) of vertices that smooth the lines through their neighbors."""
    U = U.copy()
    begin = U[at]
    lengths = np.maximum(np.linalg.norm(U[neighbors] - begin[:, None], axis=2), _SHORTEST)
    weights = lengths[:, ::-1] / lengths.sum(axis=1, keepdims=True)  # so that none slides along
    ends = np.arange(0, 2 * len(at) + 1, 2)
    mean = sp.csr_matrix((weights.ravel(), neighbors.ravel(), ends), shape=(len(at), len(U)))
    for _ in range(STEPS):
        for share in (FORWARD, BACKWARD):
            U[at] += share * (mean @ U - U[at])
    moves = U[at] - begin
    far = np.maximum(np.linalg.norm(moves, axis=1), _SHORTEST)
    return np.minimum(1.0, REACH * lengths.mean(axis=1) / far)[:, None] * moves


def _seen(U, F, directions, polygon):
    """Return the areas (m,) of triangles and of their polygons, doubled, seen along directions."""
    a, b, c = U[F].swapaxes(0, 1)
    own = np.einsum("mj,mj->m", np.cross(b - a, c - a), directions)
    return own, np.bincount(polygon, own)[polygon]
