# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of boxes that overlap: what has to be looked at to find triangles that cross.

The boxes are measured in whole steps of a grid of 2^20 per side, and sorted into the cells of an
octree: cells of about twice the size of the usual box to begin with, coarser ones if large boxes
would lie in too many, then every cell with many boxes is split as long as that helps. In each cell,
all boxes are compared with all others, by shifting the sorted arrays against themselves: nothing is
gathered, so a comparison takes about a nanosecond.
"""

import numpy as np

BITS = 20
"""of the coordinates, and levels of the octree"""
MANY = 40
"""boxes in a cell; more are split"""
MOST = 4000
"""boxes in a cell that cannot be split: more lie on top of each other, and are not compared"""

_PER_BOX = 4.0  # cells for each box, to begin with
_COARSE = 6  # the finest level at which is looked for what lies near some boxes
_GAIN = 0.8  # of the comparisons; a split that saves less is none
_BLOCK = 1 << 16  # boxes that are compared at once
_SHORT = 16  # bits: numbers of so many are compared in half of the time
_ALL_AXES = np.uint8(7)


def blocks_of_overlaps(low, high, is_asking=None):
    """Yield boxes that lie side by side in the cells of the octree.

    `low`, `high`: (m,3), corners of the boxes, from 0 to 1. `is_asking`: (m,) bool, optional, only
    pairs of one of these and one of the others are found. Gives `box`: (e,) int, boxes, some of
    them several times; `first`, `second`: (k,) int, places in it: pairs that overlap, each of them
    in one block only.
    """
    low, high = _on_grid(low), _on_grid(high)
    for cells in _leaves(low, high):
        start, end = cells.bounds
        at = 0
        while at < len(start):
            stop = max(int(np.searchsorted(end, start[at] + _BLOCK, "right")), at + 1)
            yield _compared(low, high, is_asking, cells, start[at], end[at:stop])
            at = stop


def near(low, high, is_chosen):
    """Return a mask (m,) of boxes: all that overlap a chosen one, and others close by.

    `low`, `high`: (m,3), corners of the boxes, from 0 to 1. `is_chosen`: (m,) bool.
    """
    low, high = _on_grid(low), _on_grid(high)
    chosen = low[:, is_chosen], high[:, is_chosen]
    level = min(_first_level(*chosen), _COARSE)
    low, high, *chosen = (corner >> BITS - level for corner in (low, high, *chosen))
    side = (1 << level) + 1
    before = np.zeros((side, side, side), dtype=np.int32)
    before[tuple(entries(*chosen)[1] + 1)] = 1
    for axis in range(3):  # cells of chosen boxes below each corner of the grid
        np.cumsum(before, axis=axis, out=before)
    count = np.zeros(low.shape[1], dtype=np.int32)
    for corner in np.ndindex(2, 2, 2):
        x, y, z = (end[1] + 1 if up else end[0] for up, *end in zip(corner, low, high, strict=True))
        count += before[x, y, z] * (-1 if sum(corner) % 2 == 0 else 1)
    return count > 0


class _Cells:
    """Boxes in cells of one level, those of a cell side by side.

    `box`: (e,) int. `corner`: (3,e) int32, the cell that each lies in.
    """

    def __init__(self, box, corner, level):
        self.level = level
        key = corner[0].astype(np.int64)
        for x in corner[1:]:
            key <<= level
            key |= x
        key, order = _sorted(key, 3 * level)
        self.box, self.corner = box.take(order), corner.take(order, axis=1)
        is_first = np.ones(len(key), dtype=bool)
        is_first[1:] = key[1:] != key[:-1]
        start = np.flatnonzero(is_first)
        self.bounds = start, np.append(start[1:], len(key))

    @property
    def counts(self):
        start, end = self.bounds
        return end - start

    def chosen(self, is_chosen):
        """Return some of the cells (c,), those with the most boxes first."""
        start, _ = self.bounds
        cells = np.flatnonzero(is_chosen)
        cells = cells[np.argsort(-self.counts[cells], kind="stable")]
        count = self.counts[cells]
        begin = np.append(0, np.cumsum(count))
        rows = np.arange(begin[-1]) + np.repeat(start[cells] - begin[:-1], count)
        other = _Cells.__new__(_Cells)
        other.level, other.box = self.level, self.box.take(rows)
        other.corner = self.corner.take(rows, axis=1)
        other.bounds = begin[:-1], begin[1:]
        return other


def _sorted(key, bits):
    """Return keys (e,) of so many bits in ascending order, and the order of the equal ones kept."""
    for_place = len(key).bit_length()
    if bits + for_place > 63:
        order = np.argsort(key, kind="stable")
        return key.take(order), order
    # sorted as numbers with their places behind them: a fraction of the time
    both = key << for_place
    both |= np.arange(len(key))
    both.sort()
    return both >> for_place, both & ((1 << for_place) - 1)


def _on_grid(corner):
    return (corner.T * (float(1 << BITS) - 1.0)).astype(np.int32, order="C")


def _leaves(low, high):
    """Yield the Cells of all levels in which boxes are to be compared."""
    level = _first_level(low, high)
    cells = _Cells(*entries(low >> BITS - level, high >> BITS - level), level)
    while True:
        is_full = cells.counts > MANY
        if level == BITS or not is_full.any():
            yield cells.chosen((cells.counts > 1) & (cells.counts <= MOST))
            return
        yield cells.chosen((cells.counts > 1) & ~is_full)
        level += 1
        full = cells.chosen(is_full)
        cells, stuck = _split(full, low, high)
        yield stuck.chosen(stuck.counts <= MOST)
        if not len(cells.box):
            return


def _first_level(low, high):
    """Return the level with cells of about twice the size of the usual box, or a lower one."""
    size = np.median((high - low).max(axis=0)) + 1.0
    level = int(np.clip(BITS - 1 - np.ceil(np.log2(size)), 0, BITS))
    while level > 0:
        spans = (high >> BITS - level) - (low >> BITS - level) + 1
        if spans.astype(float).prod(axis=0).sum() <= _PER_BOX * spans.shape[1] + 1000.0:
            break
        level -= 1
    return level


def entries(first, last):
    """Return the box (e,) and the cell (d,e) of every cell from first to last (d,m)."""
    spans = last - first + 1
    count = spans.prod(axis=0)
    box = np.repeat(np.arange(len(count), dtype=np.int32), count)
    number = np.arange(len(box)) - np.repeat(np.cumsum(count) - count, count)
    number = number.astype(np.int32)
    corner = np.empty((len(spans), len(box)), dtype=np.int32)
    for axis in reversed(range(len(spans))):
        number, corner[axis] = np.divmod(number, spans[axis].take(box))
        corner[axis] += first[axis].take(box)
    return box, corner


def _split(cells, low, high):
    """Return the halves along each axis of Cells, and those that are better left as they are."""
    shift = BITS - cells.level - 1
    first = np.maximum(low.take(cells.box, axis=1) >> shift, 2 * cells.corner)
    last = np.minimum(high.take(cells.box, axis=1) >> shift, 2 * cells.corner + 1)
    entry, corner = entries(first, last)
    halves = _Cells(entry, corner, cells.level + 1)
    parent = np.repeat(np.arange(len(cells.counts)), cells.counts)
    start, _ = halves.bounds
    of_parent = parent[halves.box[start]]
    work = np.bincount(of_parent, halves.counts.astype(float) ** 2, len(cells.counts))
    is_stuck = work > _GAIN * cells.counts.astype(float) ** 2
    halves.box = cells.box.take(halves.box)
    return halves.chosen(~is_stuck[of_parent]), cells.chosen(is_stuck)


def _compared(low, high, is_asking, cells, begin, ends):
    """Compare the boxes of consecutive cells, which begin at `begin` and end at `ends` (c,)."""
    entries = slice(begin, ends[-1])
    box, corner, shift = cells.box[entries], cells.corner[:, entries], BITS - cells.level
    low, high = low.take(box, axis=1), high.take(box, axis=1)
    asks = None if is_asking is None else is_asking[box]
    # Of all cells in which two boxes lie, one has the larger of their lower ends on each axis.
    is_low = (low >> shift) == corner
    lows = is_low[0].astype(np.uint8) | is_low[1].astype(np.uint8) * 2 | is_low[2] * np.uint8(4)
    if shift < _SHORT:  # boxes that overlap do so in the cell, too, where numbers are short
        origin = corner << shift
        low = np.maximum(low - origin, 0).astype(np.int16)
        high = np.minimum(high - origin, (1 << shift) - 1).astype(np.int16)
    ends = ends - begin
    counts = np.diff(ends, prepend=0)
    left = (np.repeat(ends, counts) - np.arange(len(box))).astype(np.int16)
    found = []
    for by in range(1, int(counts.max())):
        # the cells are in the order of their counts: those with few boxes come last
        size = int(ends[np.searchsorted(-counts, -by, "left") - 1]) - by
        here, there = slice(0, size), slice(by, size + by)
        is_pair = left[here] > by
        is_pair &= (lows[here] | lows[there]) == _ALL_AXES
        if asks is not None:
            is_pair &= asks[here] != asks[there]
        for below, above in zip(low, high, strict=True):
            is_pair &= below[here] <= above[there]
            is_pair &= below[there] <= above[here]
        first = np.flatnonzero(is_pair).astype(np.int32)
        found.append((first, first + by))
    first, second = (np.concatenate(ends) for ends in zip(*found, strict=True))
    return box, first, second
