# SPDX-License-Identifier: GPL-3.0-or-later
"""What would cross as sides become flat: the lighter gives way, or both stay or go as one.

Of two parts or, within one, of two of its sides. A knob goes with its door, and the sill of a
window with the wall, which both stay flat.
"""

import numpy as np

from ..algebra import sums_by_group
from ..mesh.components import components
from ..proxy.closest_point import closest_points

HEAVIER = 3.0
"""times the area of one: what crosses it stays flat, if that is enough"""
_PLACES = 256  # at most, of what would cross, that others are taken along by
_BLOCK = 256  # what is computed of so many at once stays in the cache of a core
_POINT = 1e-6


class Bodies:
    """Parts and, after them, their sides, by number.

    `rest`: RestMesh. `graph`: FaceGraph of its triangles. `side`: (m,) int of these, negative for
    those without.
    """

    def __init__(self, rest, graph, side):
        self._part, self._F = rest.topology.part, rest.F
        of_parts = np.bincount(self._part, rest.areas)
        count, region = graph.regions_of_sides(side)
        self.areas = np.concatenate([of_parts, np.bincount(region, graph.areas, count)])
        """(b,)"""
        self._side = len(of_parts) + region
        self._of_shown = self._part[rest.F[:, 0]], self._side
        if rest.unrefined is not None:
            sides = np.empty(len(rest.unrefined), np.intp)
            sides[rest.pieces] = self._side  # of a triangle, all have one
            self._of_shown = self._part[rest.unrefined[:, 0]], sides

    def of_pairs(self, pairs):
        """Return the bodies (k,2) of pairs of triangles before refinement: sides if of one part."""
        part, side = (of_shown[pairs] for of_shown in self._of_shown)
        return np.where(part[:, :1] == part[:, 1:], side, part)

    def vertices(self, bodies):
        """Return which vertices (n,) are of some of the bodies (k,)."""
        found = np.isin(self._part, bodies)
        found[self._F[np.isin(self._side, bodies)]] = True
        return found

    def giving_way(self, of_pairs, stuck):
        """Return which of pairs (k,2) of bodies go along with the other one: the much lighter.

        `stuck`: (s,2), pairs of which none does.
        """
        keys, of_stuck = (
            x.min(axis=1) * len(self.areas) + x.max(axis=1) for x in (of_pairs, stuck)
        )
        is_lighter = HEAVIER * self.areas[of_pairs] < self.areas[of_pairs[:, ::-1]]
        return is_lighter & ~np.isin(keys, of_stuck)[:, None]


def together(U, F, pairs, moves, part, is_asked, gives_way):
    """Return how far (n,3) what is near things that would come to cross goes along with them.

    Each group of these of two parts goes as one, by the mean of its moves, and one of a part, as a
    fold, stays. What gives way goes as the nearest place of the other triangle. Between groups, it
    is as Shepard's interpolation of their places has it. `U`, `moves`: (n,3). `F`: (m,3) int.
    `pairs`: (k,2) int, of triangles. `part`: (n,) int. `is_asked`: (n,) bool, the vertices that it
    is asked for. `gives_way`: (k,2) bool, see `Bodies`.
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
