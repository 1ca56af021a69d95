# SPDX-License-Identifier: GPL-3.0-or-later
"""The map from the vertices of the input to those that are solved, and back."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..aliases import IntArray
from ..values import Value


@dataclass(frozen=True, eq=False, repr=False)
class InputMap(Value):
    """How `n` solved vertices come from the `N` vertices of the input.

    First, some vertices of the input are merged, then midpoints are added, then all are
    reordered.
    """

    group: IntArray
    """(N,) int welded vertex of each vertex of the input; -1 for loose ones"""
    first: IntArray
    """(w,) int vertex of the input that gives each welded vertex its position"""
    parents: IntArray
    """(n-w,2) int the two earlier vertices that each midpoint lies between"""
    rounds: IntArray
    """(r+1,) int index in `parents` where each round of midpoints begins, and the end"""
    order: IntArray | None = None
    """(n,) int index of each solved vertex among them; None for the same order"""

    @property
    def source(self):
        """(n,) int a vertex of the input that represents each solved vertex."""
        return self._with_midpoints(self.first, lambda one, other: one)

    def place(self):
        """Return the vertices of the input that are solved, and the solved vertex of each."""
        used = np.flatnonzero(self.group >= 0)
        welded = self.group[used]
        if self.order is None:
            return used, welded
        number = np.empty(len(self.order), dtype=np.intp)
        number[self.order] = np.arange(len(self.order))
        return used, number[welded]

    def points(self, positions):
        """Return positions (N,3) of the input as those of the solved vertices (n,3)."""
        return self._with_midpoints(positions[self.first], lambda one, other: 0.5 * (one + other))

    def spread(self, values):
        """Return values (N,...) of the input at the solved vertices (n,...), averaged."""
        used = np.flatnonzero(self.group >= 0)
        if not len(self.parents) and len(self.first) == len(used):
            return values[self.source]
        flat = values[used].reshape(len(used), -1)
        count = np.bincount(self.group[used], minlength=len(self.first))
        columns = [np.bincount(self.group[used], x, len(self.first)) / count for x in flat.T]
        welded = np.stack(columns, axis=1).reshape(-1, *values.shape[1:])
        return self._with_midpoints(welded, lambda one, other: 0.5 * (one + other))

    def spread_mask(self, mask):
        """Return where a mask (N,) holds at the solved vertices (n,).

        At a welded vertex, it holds if it does for any merged vertex; at a midpoint,
        if it does at both ends.
        """
        welded = np.zeros(len(self.first), dtype=bool)
        welded[self.group[(self.group >= 0) & mask]] = True
        return self._with_midpoints(welded, np.logical_and)

    def _with_midpoints(self, welded, combine) -> Any:
        """Add the values of the midpoints to those of the welded vertices, and order them."""
        values = welded
        if len(self.parents):
            count = len(self.first) + len(self.parents)
            values = np.empty((count, *welded.shape[1:]), welded.dtype)
            values[: len(welded)] = welded
            for begin, end in zip(self.rounds[:-1], self.rounds[1:], strict=True):
                one, other = self.parents[begin:end].T
                new = combine(values[one], values[other])
                values[len(welded) + begin : len(welded) + end] = new
        return values if self.order is None else values[self.order]
