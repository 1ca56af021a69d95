# SPDX-License-Identifier: GPL-3.0-or-later
"""Which crossings can be seen from outside.

Where an arm goes into a body, or a root of hair below the skin, faces cross that nobody sees. A
crossing shows if some ray leaves from the middle of the line that both triangles have in common
and meets no other triangle. For each of some directions, triangles and lines are looked at from
there, in the cells of a grid.
"""

import numpy as np

from ..algebra import dot
from ..mesh.overlaps import entries
from ..styles.hulls import spiral

DIRECTIONS = 32
"""evenly over the sphere"""
_MOST_CELLS = 256  # of a side of the grid, whose cells then have numbers of 16 bit
_PER_TRIANGLE = 4.0  # cells: where large triangles would lie in more, cells are larger
_MOST_AT_ONCE = 1 << 21  # pairs of a point and a triangle
_OFF = 1e-6  # of the extent: what blocks is farther away


def shown(V, F, pairs):
    """Return which pairs of crossing triangles (k,2) can be seen from outside, (k,) bool.

    `V`: (n,3), finite. `F`: (m,3) int.
    """
    is_shown = np.zeros(len(pairs), dtype=bool)
    if not len(pairs):
        return is_shown
    points = _meeting_points(V, F, pairs).T
    size = float(np.ptp(V, axis=0).max())
    places, corners = np.ascontiguousarray(V.T), np.ascontiguousarray(F.T, dtype=np.intp)
    for direction in spiral(DIRECTIONS):
        rows = np.flatnonzero(~is_shown)
        if not len(rows):
            break
        turn = np.linalg.svd(direction[None])[2][[1, 2, 0]]  # the last row is along it
        turn[2] = direction
        looked, seen = _turned(turn, places), _turned(turn, points[:, rows])
        is_shown[rows] = ~_is_blocked(looked, seen, corners, pairs[rows], _OFF * size)
    return is_shown


def _meeting_points(V, F, pairs):
    """Return the middle (k,3) of what both triangles of each pair have in common."""
    ends = np.concatenate([_cut(V, F, *pairs.T), _cut(V, F, *pairs.T[::-1])], axis=1)
    line = ends - ends[:, :1]
    farthest = (line * line).sum(axis=2).argmax(axis=1)
    along = np.einsum("kex,kx->ke", line, line[np.arange(len(line)), farthest])
    inner = np.argsort(along, axis=1)[:, 1:3]
    return np.take_along_axis(ends, inner[:, :, None], axis=1).mean(axis=1)


def _cut(V, F, one, other):
    """Return the ends (k,2,3) of what the planes of other triangles cut out of triangles (k,)."""
    a, b, c = (V[F[other, k]] for k in range(3))
    corners = V[F[one]]
    height = np.einsum("kcx,kx->kc", corners - a[:, None], np.cross(b - a, c - a))
    is_above = height > 0.0
    is_rare = is_above == (is_above.sum(axis=1, keepdims=True) == 1)
    first = is_rare.argmax(axis=1)  # the corner that is alone on its side
    rows, found = np.arange(len(one)), []
    for step in (1, 2):
        next_ = (first + step) % 3
        h, g = height[rows, first], height[rows, next_]
        share = h / np.where(h == g, 1.0, h - g)
        found.append(
            corners[rows, first] + share[:, None] * (corners[rows, next_] - corners[rows, first])
        )
    return np.stack(found, axis=1)


def _turned(turn, places):
    return np.stack([dot(*axis, *places) for axis in turn])


def _is_blocked(places, points, F, pairs, least):
    """Return which points (3,k) have a triangle above, farther than `least` along Z.

    `places`: (3,n). `F`: (3,m). Not one of the two (k,2) that they lie on. The triangles of a cell
    are looked at from the top down, each time twice as many: below a pile of others, the first ones
    are enough.
    """
    near = _around(places, points, F)
    a, b, c = (places.take(corner.take(near), axis=1) for corner in F)
    low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    triangle, at, end = _in_cells(low, high, points)
    is_blocked = np.zeros(len(at), dtype=bool)
    todo, size = np.flatnonzero(at < end), 1
    while len(todo):
        count = np.minimum(size, end[todo] - at[todo])
        point, start = np.repeat(todo, count), at[todo] - np.cumsum(count) + count
        place = triangle[np.repeat(start, count) + np.arange(len(point))]
        is_near = (pairs.take(point, axis=0) != near.take(place)[:, None]).all(axis=1)
        is_near &= high[2].take(place) > points[2].take(point)
        for below, above, here in zip(low[:2], high[:2], points, strict=False):
            here = here.take(point)
            is_near &= (below.take(place) <= here) & (here <= above.take(place))
        point, place = point[is_near], place[is_near]
        A, B, C = (x.take(place, axis=1) for x in (a, b, c))
        is_above = _height(A, B, C, points.take(point, axis=1)) > least
        is_blocked[point[is_above]] = True
        at[todo] += count
        is_left = ~is_blocked[todo] & (at[todo] < end[todo])
        is_left &= high[2].take(triangle[at[todo] - 1]) >= points[2, todo]
        todo, size = todo[is_left], min(2 * size, max(_MOST_AT_ONCE // len(at), 1))
    return is_blocked


def _around(places, points, F):
    """Return the triangles (t,) above whose boxes some of the points may lie, by cells of a grid.

    Where few are asked for, they are few, and nothing else is looked up for the others.
    """
    side, origin = _MOST_CELLS, places[:2].min(axis=1, keepdims=True)
    scale = side / max(float((places[:2] - origin).max()), 1e-300)
    cell, of_points = (
        ((x[:2] - origin) * scale).astype(np.int16).clip(0, side - 1) for x in (places, points)
    )
    count = np.zeros((side + 1, side + 1), dtype=np.int32)
    count[tuple(of_points + 1)] = 1
    count = count.cumsum(axis=0).cumsum(axis=1)
    a, b, c = (cell.take(corner, axis=1) for corner in F)
    left, low = np.minimum(np.minimum(a, b), c)
    right, high = np.maximum(np.maximum(a, b), c) + 1
    inside = count[right, high] - count[left, high] + count[left, low] - count[right, low]
    return np.flatnonzero(inside)


def _in_cells(low, high, points):
    """Return the triangles whose boxes are in the cell of each point, seen from above.

    Returns `triangle`: (e,) int, in each cell the highest first; `begin`, `end`: (k,), of those of
    a point in it.
    """
    near = np.argsort(-high[2])[: np.count_nonzero(high[2] > points[2].min())]
    ends, origin = (low[:2, near], high[:2, near]), low[:2].min(axis=1, keepdims=True)
    extent = max(float((high[:2] - origin).max()), 1e-300)
    side = int(np.clip(np.sqrt(len(near)), 8, _MOST_CELLS))
    while True:
        first, last, (column, row) = (
            ((x - origin) * (side / extent)).astype(np.int32).clip(0, side - 1)
            for x in (*ends, points[:2])
        )
        if side == 1 or (last - first + 1).prod(axis=0).sum() <= _PER_TRIANGLE * len(near):
            break
        side //= 2
    number = column * side + row
    box, (column, row) = entries(first, last)
    cell = (column * side + row).astype(np.uint16)  # which are sorted in linear time
    count = np.bincount(cell, minlength=side * side)
    triangle = near[box[np.argsort(cell, kind="stable")]]
    end = np.cumsum(count)
    return triangle, (end - count)[number], end[number]


def _height(a, b, c, points):
    """Return how high triangles with corners (3,k) lie above points (3,k), or -inf."""
    u, v, w = b - a, c - a, points - a
    area = u[0] * v[1] - u[1] * v[0]
    whole = np.where(area == 0.0, 1.0, area)
    s = (w[0] * v[1] - w[1] * v[0]) / whole
    t = (u[0] * w[1] - u[1] * w[0]) / whole
    is_inside = (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0) & (area != 0.0)
    return np.where(is_inside, s * u[2] + t * v[2] - w[2], -np.inf)
