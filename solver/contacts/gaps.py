# SPDX-License-Identifier: GPL-3.0-or-later
"""What lies on the other side of the gap beside a vertex.

The largest empty ball that touches the surface at a vertex, on either side of it, ends at another
sheet (as in `proxy/thickness.py`, here also outside and between parts). What is near along the
surface is no other sheet.
"""

import numpy as np
import scipy.sparse as sp

from ..proxy.nearest import Nearest

REACH = 0.15
"""between sheets at rest, of the largest extent of all"""
NEAR_EDGES = 4
"""along the surface: fewer edges apart is the same sheet"""
LEAST_ANGLE = np.radians(80.0)
"""between the contacts of a ball, from its center; a ball of less ends at its own neighborhood"""
MOST_POINTS = 300_000
"""that the balls are measured against"""

_UNKNOWN = -2
_ROUNDS = 12
_FACING = 0.3  # cosine between the way across and the normal at either end
_SETTLED = 0.99  # a ball that shrinks by less has come to its end


class Gaps:
    """The gaps of a surface at rest, measured where they are asked for.

    `V`, `normals`: (n,3), in the unit box; unit normals, or zero. `F`: (m,3) int.
    """

    def __init__(self, V, normals, F):
        self._V, self._normals, self._points = V, normals, np.flatnonzero(normals.any(axis=1))
        self._points = self._points[:: -(-max(len(self._points), 1) // MOST_POINTS)]
        self._nearest = Nearest(V[self._points]) if len(self._points) else None
        self.graph = graph_of(F, len(V))
        # what is known of each vertex, on both sides: a round asks again for those of the last one
        self._partner = np.full((2, len(V)), _UNKNOWN)

    def partners(self, chosen):
        """Return pairs i, j (k,) of chosen vertices (c,) and vertices across a gap beside them."""
        unknown = chosen[self._partner[0, chosen] == _UNKNOWN]
        self._partner[:, unknown] = -1
        for side, sign in enumerate((1.0, -1.0)):
            i, j = self._pairs(unknown, sign)
            self._partner[side, i] = j
        i, j = np.concatenate([chosen, chosen]), self._partner[:, chosen].ravel()
        return i[j >= 0], j[j >= 0]

    def _pairs(self, chosen, sign):
        """Return pairs i, j (k,) across gaps on one side of chosen vertices."""
        i = chosen[self._normals[chosen].any(axis=1)]
        if self._nearest is None or not len(i):
            return np.empty(0, np.intp), np.empty(0, np.intp)
        j = self._across(i, sign)
        i, j = i[j >= 0], j[j >= 0]
        is_gap = self._is_facing(i, j)
        i, j = i[is_gap], j[is_gap]
        is_other = ~are_near(self.graph, i, j)
        return i[is_other], j[is_other]

    def _across(self, chosen, sign):
        """Return the vertices at which balls on one side of chosen vertices end, or -1."""
        assert self._nearest is not None
        V, n = self._V, sign * self._normals[chosen]
        radius, end = np.full(len(chosen), 0.5 * REACH), np.full(len(chosen), -1)
        todo = np.arange(len(chosen))
        for _ in range(_ROUNDS):
            p = V[chosen[todo]]
            center = p + radius[todo, None] * n[todo]
            q = self._points[self._nearest(center)]
            d = V[q] - p
            squared, depth = (d * d).sum(axis=1), (d * n[todo]).sum(axis=1)
            is_inside = (q != chosen[todo]) & (depth > 0.0)
            shrunk = squared / np.where(is_inside, 2.0 * depth, 1.0)
            is_inside &= shrunk < radius[todo]
            # half the angle between both contacts, from the center: |d| / 2r
            is_seen = is_inside & (np.sqrt(squared) > 2.0 * shrunk * np.sin(LEAST_ANGLE / 2))
            end[todo[is_seen]] = q[is_seen]
            goes_on = is_seen & (shrunk < _SETTLED * radius[todo])
            radius[todo[is_seen]] = shrunk[is_seen]
            todo = todo[goes_on]
            if not len(todo):
                break
        return end

    def _is_facing(self, i, j):
        d = self._V[j] - self._V[i]
        least = _FACING * np.linalg.norm(d, axis=1)
        one, other = ((d * self._normals[k]).sum(axis=1) for k in (i, j))
        return (np.abs(one) > least) & (np.abs(other) > least)


def graph_of(F, n):
    """Return which vertices share a triangle, or are the same, as a csr_matrix (n,n)."""
    i, j = np.concatenate([F, F[:, ::-1]]), np.roll(np.concatenate([F, F[:, ::-1]]), 1, axis=1)
    i, j = np.append(i.ravel(), np.arange(n)), np.append(j.ravel(), np.arange(n))
    graph = sp.csr_matrix((np.ones(len(i), np.float32), (i, j)), shape=(n, n))
    graph.data[:] = 1.0
    return graph


def grown(graph, mask, rings):
    """Return a mask (n,) of vertices with those up to some edges away."""
    for _ in range(rings):
        mask = graph @ mask.astype(np.float32) > 0.0
    return mask


def are_near(graph, i, j):
    """Return which vertices i and j (k,) are at most `NEAR_EDGES` apart."""
    if not len(i):
        return np.zeros(0, dtype=bool)
    starts, row = np.unique(i, return_inverse=True)
    reached = graph[starts]
    for _ in range(NEAR_EDGES - 1):
        reached = reached @ graph
        reached.data[:] = 1.0
    return np.asarray(reached[row.ravel(), j]).ravel() > 0.0
