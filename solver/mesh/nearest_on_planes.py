# SPDX-License-Identifier: GPL-3.0-or-later
"""The nearest point on the planes of a vertex, for many vertices at once."""

import numpy as np

MOST = 3
"""planes that a vertex can be moved into"""
LEAST_ANGLE = 0.1
"""sine of the angle between a plane and the earlier ones of its vertex, below which it is skipped:
their intersection would be far away"""
_ROUNDING = 1e-12
"""of the largest coordinate: a vertex closer to a plane than this lies in it"""


def nearest_on_planes(
    V, vertex, plane, normals, offsets, most, limit, walls=(), least_angle=LEAST_ANGLE
):
    """Move vertices to the nearest points that lie in their planes.

    The planes of a vertex are accepted one after the other. One that is almost parallel to those
    before, or would move the vertex farther than the limit, is skipped. A vertex that already lies
    in a plane is not moved by it.

    `V`: (n,3), positions. `vertex`, `plane`: (p,) int, pairs of a vertex and a plane, in ascending
    order of the vertices, the planes of each vertex in the order in which they are tried.
    `normals`: (f,3), unit normals of the planes. `offsets`: (f,), their distances from the origin,
    in the unit of the positions. `most`: (n,) int, how many planes each vertex can be moved into, 0
    to 3. `limit`: float, the largest distance that a vertex may be moved by, in the unit of the
    positions. `walls`: sequence of ((n,) bool, (3,)), vertices that move only along a plane, and
    its unit normal. `least_angle`: as `LEAST_ANGLE`. Returns `positions`: (n,3); `is_in`: (p,)
    bool, whether the vertex of each pair now lies in its plane.
    """
    step = np.zeros_like(V)
    basis = np.zeros((len(V), MOST + len(walls), 3))
    for number, (is_inside, normal) in enumerate(walls):
        along = _across(basis, np.broadcast_to(normal, V.shape))
        size = np.linalg.norm(along, axis=1)
        is_new = is_inside & (size > LEAST_ANGLE)
        basis[is_new, MOST + number] = along[is_new] / size[is_new, None]
    rounding = _ROUNDING * max(np.abs(V).max(initial=0.0), np.abs(offsets).max(initial=0.0))
    is_in = np.zeros(len(vertex), dtype=bool)
    count = np.zeros(len(V), dtype=np.intp)
    for pairs in _by_turn(vertex):
        v, normal = vertex[pairs], normals[plane[pairs]]
        gap = offsets[plane[pairs]] - np.einsum("pj,pj->p", normal, V[v] + step[v])
        is_in[pairs[np.abs(gap) <= rounding]] = True
        along = _across(basis[v], normal)
        size = np.linalg.norm(along, axis=1)
        is_free = (count[v] < most[v]) & (size > least_angle)
        squared = np.where(is_free, size, 1.0) ** 2
        moved = step[v] + (gap / squared)[:, None] * along
        is_taken = is_free & (np.linalg.norm(moved, axis=1) <= limit)
        v = v[is_taken]
        step[v] = moved[is_taken]
        basis[v, count[v]] = along[is_taken] / size[is_taken, None]
        count[v] += 1
        is_in[pairs[is_taken]] = True
    return V + step, is_in


def _by_turn(vertex):
    """Yield the first pair of each vertex, then the second of each that has one, and so on."""
    is_first = np.ones(len(vertex), dtype=bool)
    is_first[1:] = vertex[1:] != vertex[:-1]
    starts = np.flatnonzero(is_first)
    turn = np.arange(len(vertex)) - np.repeat(starts, np.diff(np.append(starts, len(vertex))))
    for number in range(int(turn.max(initial=-1)) + 1):
        yield np.flatnonzero(turn == number)


def _across(basis, normals):
    """Return the part (p,3) of the normals that is orthogonal to each basis (p,k,3)."""
    return normals - np.einsum("pk,pkj->pj", np.einsum("pkj,pj->pk", basis, normals), basis)
