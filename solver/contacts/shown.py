# SPDX-License-Identifier: GPL-3.0-or-later
"""Which crossings can be seen from outside.

Where an arm goes into a body, or a root of hair below the skin, faces cross that nobody sees. A
crossing shows if some ray leaves from the middle of the line that both triangles have in common
and meets no other triangle. For each of some directions, triangles and lines are looked at from
there, in the cells of a grid.
"""

import numpy as np

from ..mesh.overlaps import entries
from ..styles.hulls import spiral
from .crossings import boxes

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
    points = _meeting_points(V, F, pairs)
    size = float(np.ptp(V, axis=0).max())
    for direction in spiral(DIRECTIONS):
        rows = np.flatnonzero(~is_shown)
        if not len(rows):
            break
        turn = np.linalg.svd(direction[None])[2][[1, 2, 0]]  # the last row is along it
        turn[2] = direction
        looked = V @ turn.T, points[rows] @ turn.T
        is_shown[rows] = ~_is_blocked(*looked, F, pairs[rows], _OFF * size)
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


def _is_blocked(V, points, F, pairs, least):
    """Return which points (k,3) have a triangle above, farther than `least` along Z.

    Not one of the two (k,2) that they lie on. The triangles of a cell are looked at from the top
    down, each time twice as many: below a pile of others, the first ones are enough.
    """
    low, high = boxes(V, F)
    at, end, triangles = _columns(V, points, low, high)
    is_blocked = np.zeros(len(points), dtype=bool)
    todo, size = np.flatnonzero(at < end), 1
    while len(todo):
        count = np.minimum(size, end[todo] - at[todo])
        point, rows = np.repeat(todo, count), np.repeat(at[todo] - np.cumsum(count) + count, count)
        triangle = triangles[rows + np.arange(len(point))]
        is_near = np.ones(len(point), dtype=bool)
        for own in pairs.T:
            is_near &= own.take(point) != triangle
        for begin, stop, place in zip([*low.T[:2], None], high.T, points.T, strict=True):
            here = place.take(point)
            is_near &= stop.take(triangle) >= here
            if begin is not None:
                is_near &= begin.take(triangle) <= here
        point, triangle = point[is_near], triangle[is_near]
        is_above = _height(V[F[triangle]], points[point]) > least
        is_blocked[point[is_above]] = True
        at[todo] += count
        goes_on = ~is_blocked[todo] & (at[todo] < end[todo])
        goes_on &= high[triangles[at[todo] - 1], 2] >= points[todo, 2]
        todo, size = todo[goes_on], min(2 * size, max(_MOST_AT_ONCE // len(points), 1))
    return is_blocked


def _columns(V, points, low, high):
    """Return the triangles in the cell of each point, as `begin`, `end`: (k,), and `triangles`.

    `low`, `high`: (m,3), the boxes of triangles. Those of a cell are in the order of their tops,
    the highest first.
    """
    origin, extent = V[:, :2].min(axis=0), np.ptp(V[:, :2], axis=0).max()
    side = int(np.clip(np.sqrt(len(low)), 8, _MOST_CELLS))
    while True:
        scale = side / max(extent, 1e-300) * (1.0 - 1e-9)
        cell, first, last = (
            ((x[:, :2] - origin) * scale).astype(np.intp).clip(0, side - 1)
            for x in (points, low, high)
        )
        if side == 1 or (last - first + 1).prod(axis=1).sum() <= _PER_TRIANGLE * len(low):
            break
        side //= 2
    number = cell[:, 0] * side + cell[:, 1]
    of_cells = np.bincount(number, minlength=side * side)
    count = np.zeros((side + 1, side + 1), dtype=np.intp)
    count[1:, 1:] = of_cells.reshape(side, side).cumsum(axis=0).cumsum(axis=1)
    (x, y), (right, top) = first.T, (last + 1).T
    inside = count[right, top] - count[x, top] - count[right, y] + count[x, y]
    near = np.flatnonzero((inside > 0) & (high[:, 2] > points[:, 2].min()))
    near = near[np.argsort(-high[near, 2])]
    box, (column, row) = entries(first[near].T, last[near].T)
    of_cell = column * side + row
    kept = np.flatnonzero(of_cells[of_cell])
    of_cell = of_cell[kept].astype(np.uint16)  # which are sorted in linear time
    count = np.bincount(of_cell, minlength=side * side)
    end = np.cumsum(count)
    triangles = near[box[kept[np.argsort(of_cell, kind="stable")]]]
    return (end - count)[number], end[number], triangles


def _height(corners, points):
    """Return how high triangles (k,3,3) lie above points (k,3), -inf where they do not."""
    a, b, c = corners.transpose(1, 0, 2)
    u, v, w = b - a, c - a, points - a
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    whole = np.where(area == 0.0, 1.0, area)
    s = (w[:, 0] * v[:, 1] - w[:, 1] * v[:, 0]) / whole
    t = (u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0]) / whole
    is_inside = (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0) & (area != 0.0)
    return np.where(is_inside, s * u[:, 2] + t * v[:, 2] - w[:, 2], -np.inf)
