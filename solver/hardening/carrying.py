# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes along as sides become flat: linked parts, as eyes with a face, and what would cross."""

from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.spatial import KDTree

from ..algebra import smoothstep, sums_by_group
from ..mesh.components import components
from ..proxy.closest_point import closest_points

STILL = 0.005, 0.055
"""in the unit box: how far from what is fixed or would cross nothing goes to planes, or all does"""
HEAVIER = 3.0
"""times the area of a part: what crosses it stays flat, if that is enough"""
_MASS = 1e-3  # of the links of a part: the lighter of two goes along, and what is fixed stays
_FIXED = 1e3  # times the area of all
_PLACES = 256  # at most, of what would cross, that others are taken along by
_BLOCK = 256  # what is computed of so many at once stays in the cache of a core
_POINT = 1e-6


def carried(rest, moves, fixed):
    """Return how far (n,3) parts go along, each as a whole, where vertices (n,3) are moved so far.

    As far as the ends of their links are moved apart, in the mean:

        sum_k w_k |d_k + t_p - t_q|^2 + m sum_p a_p |t_p|^2

    for the translations t of parts p of areas a. Those with vertices `fixed` stay.
    """
    from scipy.sparse.linalg import spsolve  # takes a tenth of a second to import

    part, links = rest.topology.part, rest.to_neighbors
    first, other = part[links.vertices[:, 0]], part[links.vertices[:, 1]]
    rows = np.flatnonzero((first != other) & links.weights.any(axis=1))
    if not len(rows) or not moves.any():
        return np.zeros_like(moves)
    c, weight, count = links.coefficients[rows], links.weights[rows].sum(axis=1), part.max() + 1
    apart = np.einsum("kj,kjx->kx", c, moves[links.vertices[rows]])
    at = np.tile(np.arange(len(rows)), 2), np.concatenate([first[rows], other[rows]])
    ends = sp.csr_matrix((np.concatenate([c[:, 0], -c[:, 0]]), at), shape=(len(rows), count))
    mass = np.bincount(part, rest.areas, count)
    mass[part[fixed]] += _FIXED * mass.sum()
    mass *= _MASS * weight.sum() / mass.sum()
    pulls = ends.multiply(weight[:, None]).T.tocsr()
    matrix: Any = pulls @ ends + sp.diags(mass)
    along: Any = spsolve(matrix.tocsc(), -pulls @ apart)
    return along.reshape(count, 3)[part]


def away_from(U, vertices, times=1.0):
    """Return 0 for positions (n,3) near some vertices (k,), 1 away from them, see `STILL`."""
    if not np.size(vertices):
        return np.ones(len(U))
    start, end = np.multiply(STILL, times)
    far, _ = KDTree(U[np.unique(vertices)]).query(U, distance_upper_bound=end)
    return smoothstep(far, start, end)


def giving_way(parts, area, stuck):
    """Return which of pairs of triangles (k,2) go along with the other one: the much lighter.

    A knob goes with its door, which stays flat. `parts`: (k,2) int, of the triangles. `area`: (p,),
    of parts. `stuck`: (s,2) int, pairs of parts of which none does.
    """
    keys, of_stuck = (x.min(axis=1) * len(area) + x.max(axis=1) for x in (parts, stuck))
    is_lighter = HEAVIER * area[parts] < area[parts[:, ::-1]]
    return is_lighter & ~np.isin(keys, of_stuck)[:, None]


def together(U, F, pairs, moves, part, is_asked, gives_way):
    """Return how far (n,3) what is near things that would come to cross goes along with them.

    Each group of these of two parts goes as one, by the mean of its moves, and one of a part, as a
    fold, stays. What gives way goes as the nearest place of the other triangle. Between groups, it
    is as Shepard's interpolation of their places has it. `U`, `moves`: (n,3). `F`: (m,3) int.
    `pairs`: (k,2) int, of triangles. `part`: (n,) int. `is_asked`: (n,) bool, the vertices that it
    is asked for. `gives_way`: (k,2) bool, see `giving_way`.
    """
    at, number = np.unique(F[pairs].reshape(-1, 6), return_inverse=True)
    count, group = components(number.reshape(-1, 6), len(at))
    means = sums_by_group(moves[at], group, count) / np.bincount(group)[:, None]
    first = np.full(count, -1)
    first[group] = part[at]
    means[np.bincount(group, part[at] != first[group], count) == 0] = 0.0
    of_at = means[group]
    light, heavy = F[pairs[gives_way]], F[pairs[:, ::-1][gives_way]]
    of_at[np.searchsorted(at, heavy)] = moves[heavy]
    followers, following = _following(U, light, heavy, moves)
    of_at[np.searchsorted(at, followers)] = following
    result = np.zeros_like(U)
    step = -(-len(at) // _PLACES)
    places, of_places = U[at[::step]], of_at[::step]
    sums, sums_of_places = ((x * x).sum(axis=1) for x in (U, places))
    asked = np.flatnonzero(is_asked)
    for begin in range(0, len(asked), _BLOCK):
        rows = asked[begin : begin + _BLOCK]
        squares = U[rows] @ (-2.0 * places.T)
        squares += sums[rows, None]
        squares += sums_of_places
        np.maximum(squares, _POINT * _POINT, out=squares)
        weights = squares.min(axis=1, keepdims=True) / squares
        weights *= weights
        result[rows] = weights @ of_places / weights.sum(axis=1, keepdims=True)
    result[at] = of_at
    return result


def _following(U, light, heavy, moves):
    """Return the corners (l,) of triangles (k,3), and the moves (l,3) of the nearest of others.

    `light`, `heavy`: (k,3) int, triangles two by two.
    """
    corners, others = light.ravel(), np.repeat(heavy, 3, axis=0)
    weights = closest_points(U[corners], *U[others].swapaxes(0, 1))
    points = np.einsum("kc,kcx->kx", weights, U[others])
    order = np.lexsort((((points - U[corners]) ** 2).sum(axis=1), corners))
    found, first = np.unique(corners[order], return_index=True)
    nearest = order[first]
    return found, np.einsum("lk,lkx->lx", weights[nearest], moves[others[nearest]])
