# SPDX-License-Identifier: GPL-3.0-or-later
"""Push apart the few triangles that still cross, by moving their corners only.

A corner that lies on the wrong side of the other triangle's plane is moved along the normal of that
plane, and the point below it the other way, as in Mueller et al., "Position Based Dynamics", 2007.
Which side is the right one is known from the rest shape; where it is not, it is the nearer one.
"""

import numpy as np

from ..proxy.closest_point import closest_points
from .crossings import DEPTH, Watched, boxes

STEPS = 40
PATIENCE = 5
"""steps in which, of many pairs, a tenth has to come apart: else it is at its end"""
MANY = 100
"""pairs; with fewer, a step takes next to no time, and a late one may still help"""
MARGIN = 20.0 * DEPTH
"""between what has been pushed apart"""

REACH = 3e-3
"""that nothing is moved beyond, of the largest extent: more would be seen as a spike"""

_RINGS = 2  # of triangles around those that cross, as others may come to cross


def pushed(V, U, triangles, pairs, counts, is_free, impose):
    """Return positions (n,3) in which no more triangles cross than in U.

    `V`, `U`: (n,3), positions at rest and now. `triangles`: (m,3) int. `pairs`: (k,2) int, those of
    them that newly cross. `counts`: callable, maps pairs of triangles (k,2) to a mask (k,) of those
    that count as crossing. `is_free`: (n,) bool, vertices that may move. `impose`: callable, moves
    positions (n,3) in place so that they satisfy all constraints.
    """
    start, best, fewest, before = U, U, len(pairs), []
    is_moved, (low, high) = _moved(triangles, pairs, len(U)), boxes(U, triangles)
    margin = np.where(is_moved, REACH, 0.0)[:, None]
    watched = Watched(triangles, low - margin, high + margin, is_moved, counts)
    for _ in range(STEPS):
        is_stuck = len(before) >= PATIENCE and fewest > 0.9 * before[-PATIENCE]
        if not fewest or (is_stuck and fewest > MANY):
            break
        before.append(fewest)
        U = start + np.clip(
            U + _corrections(V, U, triangles, pairs, is_free) - start, -REACH, REACH
        )
        impose(U)
        pairs = watched.crossings(U)
        if len(pairs) < fewest:
            best, fewest = U, len(pairs)
    return best


def _moved(triangles, pairs, n):
    """Return a mask (m,) of triangles around those of pairs, which may come to cross others."""
    is_moved = np.zeros(n, dtype=bool)
    is_moved[triangles[pairs.ravel()]] = True
    for _ in range(_RINGS):
        moved = is_moved[triangles].any(axis=1)
        is_moved[triangles[moved]] = True
    return moved


def _corrections(V, U, triangles, pairs, is_free):
    one, other = triangles[pairs[:, 0]].astype(np.int64), triangles[pairs[:, 1]].astype(np.int64)
    A, B = np.concatenate([one, other]), np.concatenate([other, one])
    normal, lift, depth = _lifts(V, U, A, B)
    depth = depth.reshape(2, -1)
    is_chosen = np.zeros(depth.shape, dtype=bool)
    is_chosen[depth.argmin(axis=0), np.arange(len(one))] = True
    chosen = np.flatnonzero(is_chosen.ravel())
    row, corner = np.nonzero(lift[chosen])
    row = chosen[row]
    moves = lift[row, corner][:, None] * normal[row]
    i, under = A[row, corner], B[row]
    b = closest_points(U[i], *(U[under[:, k]] for k in range(3)))
    vertices = np.column_stack([i, under])
    shares = np.column_stack([np.ones(len(i)), -b]) * is_free[vertices]
    weight = (shares * shares).sum(axis=1)
    shares /= np.where(weight > 0.0, weight, 1.0)[:, None]
    return _means(vertices, shares, moves, len(U))


def _lifts(V, U, A, B):
    """Return how far the corners of triangles A must go along the normals of B.

    Returns `normal`: (k,3); `lift`: (k,3); `depth`: (k,), the largest of them; infinite where the
    normal has no direction.
    """
    at_rest = heights(V, A, B)[1]
    normal, height = heights(U, A, B)
    is_above = at_rest.min(axis=1) > -DEPTH
    is_below = at_rest.max(axis=1) < DEPTH
    up = np.maximum(MARGIN - height, 0.0)
    down = np.minimum(-MARGIN - height, 0.0)
    is_up = np.where(is_above == is_below, up.max(axis=1) < -down.min(axis=1), is_above)
    lift = np.where(is_up[:, None], up, down)
    return normal, lift, np.where(normal.any(axis=1), np.abs(lift).max(axis=1), np.inf)


def heights(places, A, B):
    """Return unit normals (k,3) of triangles B, and heights (k,3) of the corners of A over them."""
    a, b, c = (places[B[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.where(size > 0.0, normal / np.where(size > 0.0, size, 1.0), 0.0)
    return normal, np.einsum("kcx,kx->kc", places[A] - a[:, None], normal)


def _means(vertices, shares, moves, n):
    """Return the mean of the moves (k,3) of each vertex (n,3), by shares (k,c) of vertices."""
    flat = vertices.ravel()
    size = np.abs(shares).ravel()
    total = np.bincount(flat, size, n)
    # of several moves in the same direction the mean is enough, weighted by how much each moves it
    sums = [np.bincount(flat, (shares * move[:, None]).ravel() * size, n) for move in moves.T]
    return np.stack(sums, axis=1) / np.where(total > 0.0, total, 1.0)[:, None]
