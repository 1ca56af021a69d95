# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cycle of `multigrid.py` in Taichi."""

from functools import cache
from itertools import accumulate
from typing import Any

import numpy as np


class TaichiCycle:
    """One V-cycle on vectors with four coordinates, of which the last is not used.

    The levels lie one after the other in the same arrays, so that a single kernel does all of them:
    to start a kernel on a GPU takes longer than the work of a coarse level.

    Parameters
    ----------
    multigrid : Multigrid
    arrays : HostArrays or DeviceArrays
        Where the cycle runs.

    Attributes
    ----------
    B, X : (n,4) float32 arrays
        The scaled residual, to be filled in, and the scaled correction that `run` makes of it.
        They go on with what belongs to the coarser levels.
    """

    def __init__(self, multigrid, arrays):
        from .engine import ti

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
        self._kernel = _kernel(len(levels))
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
        self._all_rows, self._no_rows = ti.Vector(starts), ti.Vector([0] * len(starts))

    def calls(self):
        """Return a call (kernel, arguments) of each kernel that is used, of no rows."""
        return [(self._kernel, (*self._arguments, self._no_rows))]

    def run(self):
        """Do the cycle."""
        self._kernel(*self._arguments, self._all_rows)


def _stacked(matrices, columns, before=()):
    """Return indptr, indices and data of csr_matrices below each other, from the columns given.

    Parameters
    ----------
    matrices : list of csr_matrix
    columns : sequence of int
        Where the first column of each is.
    before : sequence of int
        Numbers of entries of further rows above them, which are to be zero.
    """
    counts = [np.asarray(before), *(np.diff(matrix.indptr) for matrix in matrices)]
    indices = [matrix.indices + at for matrix, at in zip(matrices, columns, strict=True)]
    data = [matrix.data for matrix in matrices]
    return (
        np.concatenate([[0], *counts]).cumsum().astype(np.int32),
        np.concatenate([np.zeros(0, np.int32), *indices]).astype(np.int32),
        np.concatenate([np.zeros(0, np.float32), *data]),
    )


@cache
def _kernel(level_count) -> Any:
    from .taichi_cycle_kernels import make_cycle

    return make_cycle(level_count)
