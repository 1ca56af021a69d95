# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles that cross.

Two triangles cross if each has corners on both sides of the other's plane and the pieces that they
have in common with the line of both planes overlap (Moeller, "A Fast Triangle-Triangle Intersection
Test", 1997). All of it by more than `DEPTH`: what only touches, lies in the same plane, or has no
area, does not cross. Triangles with a common vertex are not looked at.
"""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from ..algebra import cross, dot
from ..mesh.overlaps import blocks_of_overlaps, near

DEPTH = 1e-7
"""of the largest extent: a mesh in Blender, of numbers of 32 bit, is no more exact"""
MANY = 0.1
"""of the triangles: who asks for so many will ask for others, and to look for all takes less"""
_PARALLEL = 1e-9  # sine of the angle between planes, of which then no line is left


def crossings(V, F, is_asked=None, with_others=False):
    """Find the pairs of triangles that cross.

    `V`: (n,3). `F`: (m,3) int. `is_asked`: (m,) bool, optional, pairs of two others are left out,
    which takes little time if few are asked for. `with_others`: bool, pairs of two of these are
    left out, too. Returns (k,2) int, triangles, the lower number first, in ascending order.
    """
    V = np.asarray(V, dtype=np.float64)
    F = np.asarray(F)
    used = np.flatnonzero(np.all(np.all(np.isfinite(V), axis=1)[F], axis=1))
    if len(used) < 2 or not (is_asked is None or is_asked[used].any()):
        return np.empty((0, 2), np.intp)
    low, high = boxes(V, F[used])
    origin = low.min(axis=0)
    size = float((high.max(axis=0) - origin).max())
    if not size > 0.0:
        return np.empty((0, 2), np.intp)
    V, low, high = ((x - origin) / size for x in (V, low, high))
    if is_asked is not None:
        is_near = near(low, high, is_asked[used])
        used, low, high = used[is_near], low[is_near], high[is_near]
    planes = _Planes(V, F[used])

    def crossing(block):
        i, j = _apart(planes.F, *block)
        rows = planes.crossing(i, j)
        return np.stack([i[rows], j[rows]], axis=1).astype(np.intp)

    is_one = is_asked[used] if is_asked is not None and with_others else None
    with ThreadPoolExecutor(2) as beside:
        found = list(beside.map(crossing, blocks_of_overlaps(low, high, is_one)))
    pairs = np.sort(used[np.concatenate([np.empty((0, 2), np.intp), *found])], axis=1)
    if is_asked is not None:
        pairs = pairs[is_asked[pairs].any(axis=1)]
    return pairs[np.lexsort(pairs.T[::-1])]


class CrossingTriangles:
    """Which triangles cross others; found out where it is asked for.

    `V`: (n,3). `F`: (m,3) int.
    """

    def __init__(self, V, F):
        self._V, self._F = V, F
        self._is_known, self._is_crossing = np.zeros((2, len(F)), dtype=bool)

    def __call__(self, triangles):
        """Return which of some triangles (...) cross others."""
        is_asked = np.zeros(len(self._F), dtype=bool)
        is_asked[triangles] = True
        is_asked &= ~self._is_known
        if is_asked.mean() > MANY:
            is_asked = ~self._is_known
        if is_asked.any():
            self._is_crossing[crossings(self._V, self._F, is_asked).ravel()] = True
            self._is_known |= is_asked
        return self._is_crossing[triangles]


class Watched:
    """The pairs of triangles that may come to cross while they stay in their boxes.

    They are searched for once. Which of them cross is then found again and again in little time.

    `F`: (m,3) int. `low`, `high`: (m,3), corners of the boxes, in the unit box. `is_moved`: (m,)
    bool, triangles that move; pairs of two others are not watched. `counts`: callable, optional,
    maps pairs of triangles (k,2) to a mask (k,) of those that count if they cross.
    """

    def __init__(self, F, low, high, is_moved, counts=None):
        origin = low.min(axis=0)
        size = (high.max(axis=0) - origin).max()
        low, high = (low - origin) / size, (high - origin) / size
        used = np.flatnonzero(near(low, high, is_moved))
        corners = np.ascontiguousarray(F[used].T, dtype=np.int32)
        found = [_apart(corners, *block) for block in blocks_of_overlaps(low[used], high[used])]
        pairs = used[np.concatenate([np.empty((2, 0), np.intp), *map(np.stack, found)], axis=1)]
        pairs = pairs[:, is_moved[pairs].any(axis=0)]
        self._counts = counts
        is_used = np.zeros(len(F), dtype=bool)
        is_used[pairs] = True
        self._used = np.flatnonzero(is_used)
        self._F, self._pairs = F[self._used], (np.cumsum(is_used) - 1)[pairs]
        self._V, self._is_crossing = None, np.zeros(self._pairs.shape[1], dtype=bool)

    def crossings(self, V):
        """Return which of these pairs cross at other positions, as triangles (k,2).

        Only those that have moved since the last time are looked at; the positions must stay as
        they are until the next one.
        """
        asked = self._pairs
        if self._V is None:
            self._is_crossing[_Planes(V, self._F).crossing(*asked)] = True
        else:
            is_moved = (V != self._V).any(axis=1)[self._F].any(axis=1)
            rows = np.flatnonzero(is_moved[asked[0]] | is_moved[asked[1]])
            self._is_crossing[rows] = False
            asked = asked[:, rows]
            self._is_crossing[rows[_Planes(V, self._F).crossing(*asked)]] = True
        self._V = V
        pairs = self._used[self._pairs[:, self._is_crossing]].T
        return pairs if self._counts is None else pairs[self._counts(pairs)]


def boxes(V, F):
    """Return the lower and the upper corners (m,3) of the boxes around triangles."""
    places = np.ascontiguousarray(V.T)
    a, b, c = (places.take(corner, axis=1) for corner in F.T)
    return np.minimum(np.minimum(a, b), c).T, np.maximum(np.maximum(a, b), c).T


class _Planes:
    """Triangles with their planes: corners, three columns each, unit normals and their offsets."""

    def __init__(self, V, F):
        places = np.ascontiguousarray(V.T)
        self.F = np.ascontiguousarray(F.T, dtype=np.int32)
        self.corners = [list(places.take(corner, axis=1)) for corner in self.F]
        a, *others = self.corners
        sides = [x - begin for corner in others for x, begin in zip(corner, a, strict=True)]
        normal = np.array(cross(*sides))
        normal /= np.maximum(np.sqrt(dot(*normal, *normal)), 1e-300)
        self.normal, self.offset = list(normal), dot(*normal, *a)

    def crossing(self, i, j):
        """Return the numbers (c,) of those pairs of triangles i and j (k,) that cross."""
        rows, one = self._straddling(i, j)
        i, j = i.take(rows), j.take(rows)
        kept, other = self._straddling(j, i)
        one, i, j = one.take(kept, axis=1), i.take(kept), j.take(kept)
        return rows[kept[self._overlap(i, j, one, other) > DEPTH]]

    def _straddling(self, i, j):
        """Return the pairs whose first triangle has corners on both sides of the second.

        And how high (3,k) the corners of these lie over the plane of the second.
        """
        normal, offset = [x.take(j) for x in self.normal], self.offset.take(j)
        heights = np.empty((3, len(i)))
        for height, corner in zip(heights, self.corners, strict=True):
            np.subtract(dot(*normal, *(x.take(i) for x in corner)), offset, out=height)
        a, b, c = heights
        is_above = np.maximum(np.maximum(a, b), c) > DEPTH
        rows = np.flatnonzero(is_above & (np.minimum(np.minimum(a, b), c) < -DEPTH))
        return rows, heights.take(rows, axis=1)

    def _overlap(self, i, j, heights, other_heights):
        """Return the length (k,) that both triangles have of the line of both planes.

        `heights`, `other_heights`: (3,k), of the corners of each over the plane of the other.
        """
        one, other = ([x.take(k) for x in self.normal] for k in (i, j))
        line = np.array(cross(*one, *other))
        sine = np.sqrt(dot(*line, *line))
        line /= np.maximum(sine, 1e-300)
        begin, end = self._piece(i, heights, line)
        other_begin, other_end = self._piece(j, other_heights, line)
        length = np.minimum(end, other_end) - np.maximum(begin, other_begin)
        return np.where(sine > _PARALLEL, length, 0.0)

    def _piece(self, i, heights, line):
        """Return where on a line (3,k) triangles i enter and leave the planes of the others."""
        along = [dot(*line, *(x.take(i) for x in corner)) for corner in self.corners]
        begin, end = np.full(len(i), np.inf), np.full(len(i), -np.inf)
        for a, b in ((0, 1), (1, 2), (2, 0)):
            is_cut = (heights[a] > 0.0) != (heights[b] > 0.0)
            share = heights[a] / np.where(is_cut, heights[a] - heights[b], 1.0)
            place = along[a] + share * (along[b] - along[a])
            np.minimum(begin, np.where(is_cut, place, np.inf), out=begin)
            np.maximum(end, np.where(is_cut, place, -np.inf), out=end)
        return begin, end


def _apart(F, box, i, j):
    """Return the pairs of `blocks_of_overlaps` of triangles F (3,m) that share no vertex."""
    F = F.take(box, axis=1)
    one, other = F.take(i, axis=1), F.take(j, axis=1)
    meets = np.zeros(len(i), dtype=bool)
    for corner in one:
        meets |= (corner == other[0]) | (corner == other[1]) | (corner == other[2])
    rows = np.flatnonzero(~meets)
    return box.take(i.take(rows)), box.take(j.take(rows))
