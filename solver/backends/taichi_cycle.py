# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cycle of `multigrid.py` in Taichi."""

from functools import cache

import numpy as np

from . import taichi_runtime


class TaichiCycle:
    """One V-cycle on vectors with four coordinates, of which the last is not used.

    Parameters
    ----------
    multigrid : Multigrid
    arrays : HostArrays or DeviceArrays
        Where the cycle runs.

    Attributes
    ----------
    B, X : (n,4) float32 arrays
        The scaled residual, to be filled in, and the scaled correction that `run` makes of it.
    """

    def __init__(self, multigrid, arrays):
        self._kernels = _kernels()
        self._levels = [_Level(level, arrays) for level in multigrid.levels]
        inverse = np.linalg.inv(multigrid.coarsest.toarray()).astype(np.float32)
        self._inverse = arrays.keep(inverse, of_numbers=True)
        sizes = [level.A.shape[0] for level in multigrid.levels] + [len(inverse)]
        self._vectors = [
            [arrays.keep(np.zeros((n, 4), np.float32)) for _ in range(2)] for n in sizes
        ]
        self.B, self.X = self._vectors[0]

    def calls(self):
        """Return one call (kernel, arguments) of each kernel that is used."""
        kernels, (b, x) = self._kernels, self._vectors[-1]
        calls = [(kernels.multiply_dense, (self._inverse, b, x))]
        if self._levels:
            level, (B, X) = self._levels[0], self._vectors[0]
            smoothing = (level.of_b, level.of_ab)
            calls += [
                (kernels.smooth, (*level.A, B, X, *smoothing)),
                (kernels.subtract, (*level.A, X, B, level.residual)),
                (kernels.multiply, (*level.restrict, level.residual, b)),
                (kernels.add, (*level.P, x, X)),
                (kernels.smooth_more, (*level.A, level.residual, X, *smoothing)),
            ]
        return calls

    def run(self):
        """Do the cycle."""
        kernels, levels = self._kernels, list(zip(self._levels, self._vectors[:-1], strict=True))
        for (level, (B, X)), (b, _) in zip(levels, self._vectors[1:], strict=True):
            kernels.smooth(*level.A, B, X, level.of_b, level.of_ab)
            kernels.subtract(*level.A, X, B, level.residual)
            kernels.multiply(*level.restrict, level.residual, b)
        kernels.multiply_dense(self._inverse, *self._vectors[-1])
        for (level, (B, X)), (_, x) in zip(levels[::-1], self._vectors[:0:-1], strict=True):
            kernels.add(*level.P, x, X)
            kernels.subtract(*level.A, X, B, level.residual)
            kernels.smooth_more(*level.A, level.residual, X, level.of_b, level.of_ab)


class _Level:
    def __init__(self, level, arrays):
        self.A, self.P, self.restrict = (
            tuple(map(arrays.keep, (matrix.indptr, matrix.indices, matrix.data)))
            for matrix in (level.A, level.P, level.restrict)
        )
        self.of_b, self.of_ab = float(level.of_b), float(level.of_ab)
        self.residual = arrays.keep(np.zeros((level.A.shape[0], 4), np.float32))


@cache
def _kernels():
    taichi_runtime.import_taichi()
    from .taichi_cycle_kernels import make_cycle_kernels

    return make_cycle_kernels()
