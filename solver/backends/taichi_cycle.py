# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cycles of `multigrid.py` in Taichi."""

from itertools import accumulate

import numpy as np

ON_PROCESSOR, ON_DEVICE = 1, 2
"""V-cycles in each iteration. With one, a run takes up to twice as many iterations as with the
factorization. Two cost a GPU little, which waits for launches rather than for arithmetic; the
processor is as soon at the end with either."""
_LEAST = 0.3
"""Several treat alike what V-cycle times matrix takes to between this and 1, its greatest."""


def chebyshev_weights(cycles):
    """Return the weights (cycles,) of V-cycles in a row, and the factor of their sum.

    The weights are those of Chebyshev's semi-iteration (Golub and Varga, "Chebyshev semi-iterative
    methods", 1961). With the factor no part of the error is corrected by more than it is: more, and
    the iteration would not descend.
    """
    if cycles == 1:
        return np.ones(1), 1.0
    middle, half = (1 + _LEAST) / 2, (1 - _LEAST) / 2
    roots = middle + half * np.cos((2 * np.arange(cycles) + 1) * np.pi / (2 * cycles))
    return 1 / roots, 1 / (1 + 1 / np.cosh(cycles * np.arccosh(middle / half)))


class TaichiCycle:
    """V-cycles on vectors with four coordinates, of which the last is not used.

    The levels lie one after the other in the same arrays, so that a single kernel does all of them:
    to start a kernel on a GPU takes longer than the work of a coarse level.

    `arrays`: where they run. `cycles`: how many; by default `ON_PROCESSOR` or `ON_DEVICE`. `B`,
    `X`: (n,4) float32, the scaled residual, to be filled in, and the scaled correction that `run`
    makes of it; they go on with what belongs to the coarser levels.
    """

    def __init__(self, multigrid, arrays, cycles=None):
        from .engine import ti
        from .taichi_cycle_kernels import make_cycle, make_refining_kernels

        levels = multigrid.levels
        inverse = np.linalg.inv(multigrid.coarsest.toarray()).astype(np.float32)
        sizes = [level.A.shape[0] for level in levels] + [len(inverse)]
        starts = (0, *accumulate(sizes))
        here, below = starts[:-2], starts[1:-1]  # where the rows of each level begin
        of_finest = np.zeros(sizes[0] if levels else 0, np.int64)  # nothing is restricted to it
        matrices = (
            *_stacked([level.A for level in levels], here),
            *_stacked([level.P for level in levels], below),
            *_stacked([level.restrict for level in levels], here, of_finest),
        )
        self.B, self.X, residual = (
            arrays.keep(np.zeros((starts[-1], 4), np.float32)) for _ in range(3)
        )
        self._kernel, self._refine = make_cycle(len(levels)), make_refining_kernels()
        self._arguments = (
            *map(arrays.keep, matrices),
            arrays.keep(inverse, of_numbers=True),
            self.B,
            self.X,
            residual,
            # A kernel takes tuples as well, but Quadrants warns of what it cannot refer to weakly.
            ti.Vector([*(float(level.of_b) for level in levels), 0.0]),
            ti.Vector([*(float(level.of_ab) for level in levels), 0.0]),
        )
        self._refining = ()
        cycles = cycles or (ON_DEVICE if arrays.is_resident else ON_PROCESSOR)
        self._weights, self._factor = chebyshev_weights(cycles if levels else 1)  # else it is exact
        if len(self._weights) > 1:
            total = arrays.keep(np.zeros((sizes[0], 4), np.float32))
            self._refining = (*self._arguments[:3], self.B, self.X, total)
        self._count = sizes[0]
        self._all_rows, self._no_rows = ti.Vector(starts), ti.Vector([0] * len(starts))

    def calls(self):
        """Return a call (kernel, arguments) of each kernel that is used, of no rows."""
        calls = [(self._kernel, (*self._arguments, self._no_rows))]
        if self._refining:
            calls += [
                (self._refine.add, (*self._refining, 0, 1.0)),
                (self._refine.together, (*self._refining[-2:], 0, 1.0, 1.0)),
            ]
        return calls

    def run(self):
        """Do the cycles."""
        *weights, last = map(float, self._weights)
        for weight in weights:
            self._kernel(*self._arguments, self._all_rows)
            self._refine.add(*self._refining, self._count, weight)
        self._kernel(*self._arguments, self._all_rows)
        if weights:
            ends = self._count, last, float(self._factor)
            self._refine.together(*self._refining[-2:], *ends)


def _stacked(matrices, columns, before=()):
    """Return indptr, indices and data of csr_matrices below each other, from the columns given.

    `matrices`: list of csr_matrix. `columns`: sequence of int, where the first column of each is.
    `before`: sequence of int, numbers of entries of further rows above them, which are to be zero.
    """
    counts = [np.asarray(before), *(np.diff(matrix.indptr) for matrix in matrices)]
    indices = [matrix.indices + at for matrix, at in zip(matrices, columns, strict=True)]
    data = [matrix.data for matrix in matrices]
    return (
        np.concatenate([[0], *counts]).cumsum().astype(np.int32),
        np.concatenate([np.zeros(0, np.int32), *indices]).astype(np.int32),
        np.concatenate([np.zeros(0, np.float32), *data]),
    )
