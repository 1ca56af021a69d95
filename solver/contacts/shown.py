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
    """Return places (3,k) times a matrix, which takes less time than a product of matrices."""
    return np.stack([dot(*axis, *places) for axis in turn])


def _is_blocked(places, points, F, pairs, least):
    """Return which points (3,k) have a triangle above, farther than `least` along Z.

    `places`: (3,n). `F`: (3,m). Not one of the two (k,2) that they lie on. The triangles of a cell
    are looked at from the top down, each time twice as many: below a pile of others, the first ones
    are enough.
    """
    at, end, found, triangles, low, high = _columns(places, points, F)
    is_blocked = np.zeros(len(at), dtype=bool)
    todo, size = np.flatnonzero(at < end), 1
    while len(todo):
        count = np.minimum(size, end[todo] - at[todo])
        point, rows = np.repeat(todo, count), np.repeat(at[todo] - np.cumsum(count) + count, count)
        place = found[rows + np.arange(len(point))]
        is_near = np.ones(len(point), dtype=bool)
        for own in pairs.T:
            is_near &= own.take(point) != triangles.take(place)
        for begin, stop, here in zip([*low, None], high, points, strict=True):
            here = here.take(point)
            is_near &= stop.take(place) >= here
            if begin is not None:
                is_near &= begin.take(place) <= here
        point, place = point[is_near], place[is_near]
        a, b, c = (places.take(corner, axis=1) for corner in F.take(triangles[place], axis=1))
        is_above = _height(a, b, c, points.take(point, axis=1)) > least
        is_blocked[point[is_above]] = True
        at[todo] += count
        goes_on = ~is_blocked[todo] & (at[todo] < end[todo])
        goes_on &= high[2][found[at[todo] - 1]] >= points[2, todo]
        todo, size = todo[goes_on], min(2 * size, max(_MOST_AT_ONCE // len(at), 1))
    return is_blocked


def _columns(places, points, F):
    """Return the triangles in the cell of each point.

    Returns `begin`, `end`: (k,), of the rows of `found`: (e,) int, numbers of `triangles`: (t,)
    int. Those of a cell are in the order of their tops, the highest first. `low`: two (t,), and
    `high`: three, the boxes of these triangles.
    """
    origin = places[:2].min(axis=1)
    extent = (places[:2].max(axis=1) - origin).max()
    side = int(np.clip(np.sqrt(F.shape[1]), 8, _MOST_CELLS))
    while True:
        scale = side / max(extent, 1e-300) * (1.0 - 1e-9)
        cell, of_corners = (_cells(ends, origin, scale, side) for ends in (points, places))
        first, last = _between_corners(of_corners, F)
        width, depth = (last - first + 1).T
        # no product of BLAS, whose threads would wait longer for each other than they compute
        count = np.multiply(width, depth, dtype=np.int32).sum()
        if side == 1 or count <= _PER_TRIANGLE * len(first):
            break
        side //= 2
    number = cell[:, 0] * np.intp(side) + cell[:, 1]
    of_cells = np.bincount(number, minlength=side * side)
    near = _around(of_cells.reshape(side, side), first, last)
    tops = places[2].take(F.take(near, axis=1)).max(axis=0)
    order = np.argsort(-tops)[: np.count_nonzero(tops > points[2].min())]
    near, tops = near[order], tops[order]
    corners = F.take(near, axis=1)
    low, high = (
        [limit.reduce(along.take(corners)) for along in places[:2]]
        for limit in (np.minimum, np.maximum)
    )
    box, (column, row) = entries(*(ends[near].T.astype(np.int32) for ends in (first, last)))
    of_cell = column * side + row
    kept = np.flatnonzero(of_cells[of_cell])
    of_cell = of_cell[kept].astype(np.uint16)  # which are sorted in linear time
    count = np.bincount(of_cell, minlength=side * side)
    end = np.cumsum(count)
    found = box[kept[np.argsort(of_cell, kind="stable")]]
    return (end - count)[number], end[number], found, near, low, [*high, tops]


def _cells(places, origin, scale, side):
    """Return the cells (k,2) int16 of a grid that places (3,k) lie in."""
    cells = np.empty((places.shape[1], 2), np.int16)
    for axis in range(2):
        cells[:, axis] = ((places[axis] - origin[axis]) * scale).clip(0, side - 1)
    return cells


def _between_corners(cells, F):
    """Return the first and the last cells (m,2) of triangles, from those (n,2) of their corners."""
    both = cells.view(np.int32).ravel()  # that both numbers are taken at once
    a, b, c = (both.take(corner).view(np.int16).reshape(-1, 2) for corner in F)
    return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)


def _around(of_cells, first, last):
    """Return the triangles (t,) that may lie above one of the points counted in cells (s,s)."""
    side = len(of_cells)
    count = np.zeros((side + 1, side + 1), dtype=np.int32)
    count[1:, 1:] = of_cells.cumsum(axis=0).cumsum(axis=1)
    count = count.ravel()
    rows = np.arange(0, (side + 1) ** 2, side + 1)
    (left, low), (right, high) = first.T, (last + np.int16(1)).T
    left, right = rows.take(left), rows.take(right)
    inside = count.take(right + high) - count.take(left + high)
    inside += count.take(left + low) - count.take(right + low)
    return np.flatnonzero(inside > 0)


def _height(a, b, c, points):
    """Return how high triangles with corners (3,k) lie above points (3,k), or -inf."""
    u, v, w = b - a, c - a, points - a
    area = u[0] * v[1] - u[1] * v[0]
    whole = np.where(area == 0.0, 1.0, area)
    s = (w[0] * v[1] - w[1] * v[0]) / whole
    t = (u[0] * w[1] - u[1] * w[0]) / whole
    is_inside = (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0) & (area != 0.0)
    return np.where(is_inside, s * u[2] + t * v[2] - w[2], -np.inf)
