# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles, their edges, and which triangles share them."""

from functools import cached_property

import numpy as np

from .components import components
from .rest_measures import triangle_areas_and_normals


class Edges:
    """The edges of triangles F (m,3) between n vertices.

    `lower`, `upper`: (e,) int32, the ends of each edge, in ascending order; both are the same for
    the side of a collapsed triangle. `number`: (3,m) int, the edge opposite each corner.
    `is_backward`: (3,m) bool, where it runs from its upper to its lower end, in the direction of
    the triangle.
    """

    def __init__(self, F, n):
        corners = F.T.astype(np.int32, order="C")
        start, end = corners[[1, 2, 0]], corners[[2, 0, 1]]
        self.is_backward = start > end
        lower, upper = np.minimum(start, end).ravel(), np.maximum(start, end).ravel()
        self._order, is_new, self.number = _numbered(lower, upper, n)
        self.number = self.number.reshape(start.shape)
        self._is_new = is_new
        first = self._order[is_new]
        self.lower, self.upper = lower[first], upper[first]

    @cached_property
    def uses(self):
        """(e,) int, how many triangles have each edge: an open one has one."""
        return np.bincount(self.number.ravel())

    @cached_property
    def rims(self):
        """The vertices (k,) int of open rims, ascending, and the number (k,) of the rim of each."""
        ends = np.stack([self.lower, self.upper], axis=1)[self.uses == 1]
        vertices, at = np.unique(ends, return_inverse=True)
        return vertices, components(at.reshape(-1, 2), len(vertices))[1]

    def triangles(self):
        """Return pairs (k,) and (k,) of triangles that have an edge in common.

        If an edge has more than two triangles, each is paired with the next.
        """
        return self.pairs()[:2]

    def pairs(self):
        """Return the same, and the number of the edge (k,) of each pair."""
        is_edge = self.lower != self.upper
        is_same = ~self._is_new
        is_same[is_same] = is_edge[self.number.ravel()[self._order[is_same]]]
        other = np.flatnonzero(is_same)
        m = self.number.shape[1]  # pyright: ignore[reportGeneralTypeIssues]
        edge = self.number.ravel()[self._order[other]]
        return self._order[other - 1] % m, self._order[other] % m, edge


class Triangles:
    """What several steps of the set-up need of the triangles of a surface, computed once.

    Its Edges, and its areas and normals as `triangle_areas_and_normals` returns them. Not kept in a
    `RestMesh`: of a million vertices this would be 300 MB.

    `V`: (n,3) float, positions in the unit box. `F`: (m,3) int.
    """

    def __init__(self, V, F):
        self.V, self.F = V, F
        self.edges = Edges(F, len(V))
        self.areas, self.normals = triangle_areas_and_normals(V, F)

    def parts(self, part):
        """Return the part (m,) of each triangle from those of the vertices (n,)."""
        return part[self.F[:, 0]]


def distinct(F):
    """Return the triangles with three different corners, one of each set of corners."""
    return F[distinct_rows(F)]


def distinct_rows(F):
    """Return which triangles (k,) have three different corners, one of each set of corners."""
    rows = np.flatnonzero((F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0]))
    corners = np.sort(F[rows].astype(np.int64), axis=1)
    order = np.lexsort(corners.T[::-1])
    ordered = corners[order]
    is_new = np.ones(len(rows), dtype=bool)
    is_new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    return rows[np.sort(order[is_new])]


def edges_of(start, end, n):
    """Find which of many edges between n vertices are the same, in either direction.

    `start`, `end`: (h,) int. Returns `edges`: (e,2) int, each edge once, the lower end first, in
    ascending order; `number`: (h,) int, the index of each given edge among them.
    """
    lower, upper = np.minimum(start, end), np.maximum(start, end)
    order, is_new, number = _numbered(lower, upper, n)
    first = order[is_new]
    return np.stack([lower[first], upper[first]], axis=1), number


def _numbered(lower, upper, n):
    """Return numbers of pairs below n, in ascending order.

    Returns `order`: (h,) int, their stable order; `is_new`: (h,) bool, which are not as the one
    before in it; `number`: (h,) int, of each pair; the same if they are.
    """
    order = stable_order(upper, n)
    order = order[stable_order(lower[order], n)].astype(np.intp)
    lower, upper = lower[order], upper[order]
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = (lower[1:] != lower[:-1]) | (upper[1:] != upper[:-1])
    number = np.empty(len(order), dtype=np.intp)
    number[order] = np.cumsum(is_new) - 1
    return order, is_new, number


def stable_order(keys, count):
    """Return the stable order of integer keys below count, by counting instead of comparing."""
    import scipy.sparse as sp  # Blender reads charts when the add-on is enabled, perhaps without it

    rows = np.arange(len(keys) + 1, dtype=np.int32)
    one_per_row = sp.csr_matrix((keys, keys, rows), shape=(len(keys), count))
    return one_per_row.tocsc().indices
