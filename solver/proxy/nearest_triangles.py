# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangle of another part that is nearest to a vertex, however many parts there are.

Each large part has a tree of its own, which all vertices near it but its own ask. The triangles of
the small ones, of which there may be thousands, are found where their boxes overlap those around
the vertices. What is found is compared block by block, and only the nearest is kept.
"""

import numpy as np

from ..algebra import by_columns, columns, dot, take
from ..mesh.overlaps import blocks_of_overlaps
from .closest_point import closest_points
from .nearest import Nearest

FEW = 64
"""parts, the largest ones, that are looked at one by one: all parts of most meshes"""
SMALL = 256
"""triangles of a part; one with more is also looked at alone, as too many are near each other"""

_CANDIDATES = 6  # triangles of a large part, by their centers, among which the nearest is searched
_CORNERS = 8  # of small parts, around a vertex, by which the search for their triangles is bounded
_BLOCK = 1 << 18  # pairs that are compared at once


class NearestTriangles:
    """The search from some vertices.

    `V`: (n,3), rest positions in the unit box. `corners`: (m,3) int, triangles. `part`: (n,) int.
    `chosen`: (k,) int, the vertices to search from. `sizes`: (p,), extents of the parts. `reach`:
    callable, maps an extent to how far (k,) a part of this extent, or less, is searched for.
    `triangle`: (k,) int, the nearest triangle of another part within reach of each, or -1.
    """

    def __init__(self, V, corners, part, chosen, sizes, reach):
        self._V, self._corners, self._chosen = by_columns(V), corners, chosen
        self._of_corner = part
        self._of_vertex, self._of_face = part[chosen], part[corners[:, 0]]
        self._from = take(self._V, chosen)
        self.triangle = np.full(len(chosen), -1)
        self._squared = reach(sizes.max()) ** 2
        self._farthest = float(self._squared.max()) ** 0.5
        a, b, c = self._places(np.arange(len(corners)))
        self._middles = (a + b + c) / 3.0
        self._sizes = np.sqrt(
            np.max([_squared(corner - self._middles) for corner in (a, b, c)], axis=0)
        )
        count = np.bincount(self._of_face, minlength=len(sizes))
        is_large = count > SMALL
        is_large[np.argsort(-sizes, kind="stable")[:FEW]] = True
        order, end = np.argsort(self._of_face, kind="stable"), np.cumsum(count)
        for k in np.flatnonzero(is_large & (count > 0)):
            self._ask(k, order[end[k] - count[k] : end[k]])
        if not is_large.all():
            # beyond, they only matter where they are nearer than what has been found
            limit = reach(sizes[~is_large].max()) ** 2
            np.minimum(self._squared, limit, out=self._squared, where=self.triangle < 0)
            self._ask_boxes(np.flatnonzero(~is_large[self._of_face]))

    def ways(self):
        """Return where a triangle has been found, and how to get there.

        Returns `i`, `triangle`: (f,) int, vertices, in ascending order, and triangles;
        `barycentric`: (f,3), of the nearest point; `d`: (f,3), from the vertex to it.
        """
        rows = np.flatnonzero(self.triangle >= 0)
        rows = rows[np.argsort(self._chosen[rows])]
        return self._chosen[rows], self.triangle[rows], *self._ways(rows, self.triangle[rows])

    def _places(self, triangles):
        return [take(self._V, self._corners[triangles, k]) for k in range(3)]

    def _ways(self, rows, triangles):
        a, b, c = self._places(triangles)
        P = take(self._from, rows)
        barycentric = closest_points(P, a, b, c)
        points = barycentric[:, :1] * a + barycentric[:, 1:2] * b + barycentric[:, 2:] * c
        return barycentric, points - P

    def _ask(self, k, triangles):
        """Compare the vertices near a large part, of its triangles, with those of its tree."""
        places, middles = columns(self._from), self._middles[triangles]
        size = self._sizes[triangles].max()
        is_asking = is_in_box(places, middles.T, self._farthest + size)
        rows = np.flatnonzero(is_asking & (self._of_vertex != k))
        reach = np.sqrt(self._squared[rows]) + size
        is_asking = is_in_box(places[:, rows], middles.T, reach)
        if not is_asking.any():
            return
        rows, bound = rows[is_asking], float(reach[is_asking].max())
        is_near = is_in_box(middles.T, places[:, rows], bound)
        triangles, middles = triangles[is_near], middles[is_near]
        if not len(triangles):
            return
        count = min(_CANDIDATES, len(triangles))
        nearest = Nearest(middles)
        for block in np.array_split(rows, -(-len(rows) * count // _BLOCK)):
            found = nearest(self._from[block], k=count, distance_upper_bound=bound).ravel()
            is_found = found < len(triangles)
            self._compare(np.repeat(block, count)[is_found], triangles[found[is_found]])

    def _ask_boxes(self, triangles):
        """Compare vertices with the triangles of small parts whose boxes are within their reach."""
        squared, corners = self._squared.copy(), self._places(triangles)
        self._bound(triangles, squared)
        reach = np.sqrt(squared)[:, None]
        low = np.concatenate([self._from - reach, np.min(corners, axis=0)])
        high = np.concatenate([self._from + reach, np.max(corners, axis=0)])
        origin = low.min(axis=0)
        low, high = low - origin, high - origin
        size = float(high.max()) or 1.0
        count = len(reach)
        is_vertex = np.arange(len(low)) < count
        for box, i, j in blocks_of_overlaps(low / size, high / size, is_vertex):
            i, j = np.sort([box[i], box[j]], axis=0)
            j = triangles[j - count]
            is_other = self._of_vertex[i] != self._of_face[j]
            self._compare(i[is_other], j[is_other])

    def _bound(self, triangles, squared):
        """Lower the squares of distances (k,) to where corners of other parts of these are.

        It takes little time, and leaves most boxes that would overlap out.
        """
        corners = np.unique(self._corners[triangles])
        places, part = take(self._V, corners), np.append(self._of_corner[corners], -1)
        count = min(_CORNERS, len(corners))
        nearest, reach = Nearest(places), float(squared.max()) ** 0.5
        places = np.concatenate([places, np.full((1, 3), np.inf)])
        for block in np.array_split(np.arange(len(squared)), -(-len(squared) * count // _BLOCK)):
            here = self._from[block]
            found = nearest(here, k=count, distance_upper_bound=reach).reshape(-1, count)
            for column in found.T:
                is_other = part[column] != self._of_vertex[block]
                d = _squared(places[column] - here)
                # a little more than it is, so that the triangle of this corner is found itself
                d = np.where(is_other, (1.0 + 1e-9) * d + 1e-24, np.inf)
                squared[block] = np.minimum(squared[block], d)

    def _compare(self, rows, triangles):
        """Keep the triangles that are nearer than what has been found from the vertices so far."""
        squared = _squared(self._ways(rows, triangles)[1])
        is_nearer = squared <= self._squared[rows]
        rows, triangles, squared = rows[is_nearer], triangles[is_nearer], squared[is_nearer]
        order = np.lexsort((triangles, squared, rows))
        rows, triangles, squared = rows[order], triangles[order], squared[order]
        is_first = np.ones(len(rows), dtype=bool)
        is_first[1:] = rows[1:] != rows[:-1]
        rows, triangles, squared = rows[is_first], triangles[is_first], squared[is_first]
        # of equally near ones, the first, in whatever order they are found
        before = self.triangle[rows]
        is_better = (squared < self._squared[rows]) | (before < 0) | (triangles < before)
        self.triangle[rows[is_better]] = triangles[is_better]
        self._squared[rows[is_better]] = squared[is_better]


def _squared(d):
    return dot(*columns(d), *columns(d))


def is_in_box(points, others, reach):
    """Return which points (3,n) are within reach of the box around others (3,k)."""
    is_inside = np.ones(points.shape[1], dtype=bool)
    for here, there in zip(points, others, strict=True):
        is_inside &= (here >= there.min() - reach) & (here <= there.max() + reach)
    return is_inside
