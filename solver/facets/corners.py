# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the corners of polygons go: to where the planes of their regions meet.

Corners that the planes have no room for become one with their neighbors. Where outlines with few
corners cross each other nevertheless, they get more.
"""

import numpy as np
from scipy.spatial import KDTree

from ..mesh.nearest_on_planes import MOST, nearest_on_planes
from .joining import crowded, joined, tangled, without_needless
from .meeting import met
from .outlines import Outlines
from .polygons import crossings

COURSE = 0.01
"""of the size: how far the border of two sides may leave its course"""
FLATNESS = 2e-4
"""of the size: how far the corners of a polygon may be from its plane"""
FARTHEST = 3.0
"""of the tolerance: how far a corner may go along the surface, if a vertex is near there"""
_LEAST_ANGLE = 0.02  # sine, between planes that meet in a corner
_CLOSER = 0.25  # of its course, for the outline of a part that crosses itself
_TRIES = 4
_ROUNDS = 8
_NEAR = 16  # vertices that may stand for a corner


class Corners:
    """The corners of parts of regions.

    `W`, `G`: positions (n,3) and triangles (m,3). `graph`: FaceGraph of these. `regions`: Regions.
    `parts`: (m,) int, the part of each triangle; parts lie in one region each. `tolerance`: float,
    how far vertices may be moved. `walls`: as of `nearest_on_planes`.

    `positions`: (n,3), where the corners go. `loops`: as of `Outlines`. `normals`: (k,3), the unit
    normal of each part.
    """

    def __init__(self, W, G, graph, regions, parts, tolerance, walls):
        self._W, self._tolerance, self._walls = W, tolerance, walls
        self._tree = KDTree(W)
        self._region = np.zeros(parts.max() + 1, np.int64)
        self._region[parts] = regions.of_triangle
        facing = regions.normals[self._region]
        start = self._in_planes(_pairs(G, regions.of_triangle), regions, tolerance)
        course = np.full(len(facing), COURSE)
        fewest = np.inf
        for _ in range(_TRIES):
            found = Outlines(start, G, parts, facing, course).loops
            loops, positions, normals = self._settled(found, G, graph, regions)
            crossed = [n for n, of in loops.items() if crossings(positions, of, normals[n])]
            if len(crossed) < fewest:
                fewest = len(crossed)
                self.loops, self.positions, self.normals = loops, positions, normals
            if not crossed:
                break
            course[crossed] *= _CLOSER

    def _settled(self, loops, G, graph, regions):
        W = self._W
        for _ in range(_ROUNDS):
            corners = [(v, self._region[n]) for n, of in loops.items() for v in set().union(*of)]
            corners = np.unique(np.array(corners, np.int64).reshape(-1, 2), axis=0)
            meeting = met(W, G, graph, regions, corners, self._walls)
            P = self._placed(corners, meeting)
            normals = meeting.normals[self._region]
            fewer, is_less = without_needless(P, loops, FLATNESS)
            fewer, is_joined = joined(W, fewer, crowded(W, P, fewer))
            if not is_less and not is_joined:
                fewer, is_joined = joined(W, loops, tangled(P, loops, normals))
                if not is_joined:
                    break
            loops = fewer
        return loops, P, normals

    def _placed(self, corners, regions):
        """Return where corners go: also farther along the surface, if a vertex is near there."""
        P = self._in_planes(corners, regions, self._tolerance)
        far = self._in_planes(corners, regions, FARTHEST * self._tolerance)
        moved = np.flatnonzero((far != P).any(axis=1))
        moved = moved[self._tree.query(far[moved])[0] <= self._tolerance]
        P[moved] = far[moved]
        return P

    def _in_planes(self, pairs, regions, limit):
        W, most = self._W, np.full(len(self._W), MOST)
        vertex, plane = pairs.T
        normals, offsets, walls = regions.normals, regions.offsets, self._walls
        return nearest_on_planes(
            W, vertex, plane, normals, offsets, most, limit, walls, _LEAST_ANGLE
        )[0]

    def anchored(self, polygons):
        """Return polygons with the nearest vertices in place of corners that have gone far."""
        P, used = self.positions, {v for loop in polygons for v in loop}
        instead = {}
        for v in sorted(used):
            if np.linalg.norm(P[v] - self._W[v]) <= self._tolerance:
                continue
            found = self._tree.query(P[v], min(_NEAR, len(P)))
            gaps, near = map(np.atleast_1d, found)
            near = near[gaps <= self._tolerance].tolist()
            w = next((w for w in near if w not in used), v)
            instead[v] = w
            used.add(w)
            P[w] = P[v]
        return [[instead.get(v, v) for v in loop] for loop in polygons]


def _pairs(G, region):
    count = region.max() + 1
    keys = np.unique(G.astype(np.int64) * count + region[:, None])
    return np.stack(np.divmod(keys, count), axis=1)
