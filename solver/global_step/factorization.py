# SPDX-License-Identifier: GPL-3.0-or-later
"""Factorize a sparse positive definite matrix once, then solve for three columns at a time."""

import weakref
from contextlib import nullcontext, suppress

import numpy as np

from ..optional_packages import optional_package


def factorize(A):
    """Return a function from B (n,3) to X with A X = B; A: (n,n) csr_matrix, positive definite."""
    cholespy = optional_package("cholespy")  # about twice as fast as SciPy's LU at solving
    if cholespy is not None:
        with suppress(ImportError, AttributeError, TypeError):  # of a broken installation
            return _Cholesky(cholespy, A)
    from scipy.sparse.linalg import splu  # takes a tenth of a second to import

    with _one_blas_thread():
        lu = splu(
            A.tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    return lu.solve


def _one_blas_thread():
    """Keep BLAS from sharing out products as small as those of a factorization.

    It gains nothing, and where other programs use the cores, its threads wait for each other a
    hundred times as long as they compute.
    """
    threadpoolctl = optional_package("threadpoolctl")
    if threadpoolctl is None:
        return nullcontext()
    return threadpoolctl.threadpool_limits(1, user_api="blas")


class _Cholesky:
    def __init__(self, cholespy, A):
        self._solver = cholespy.CholeskySolverD(
            A.shape[0],
            A.indptr.astype(np.int32),
            A.indices.astype(np.int32),
            A.data,
            cholespy.MatrixType.CSR,  # it would take ownership of arrays in column order, and crash
        )
        self._has_solved = False

    def __call__(self, B):
        X = np.empty_like(B, order="C")
        self._solver.solve(np.ascontiguousarray(B), X)
        if not self._has_solved:
            self._has_solved = True
            self._free_at_end(len(B))
        return X

    def _free_at_end(self, n):
        """Release the memory, as large as B, that cholespy 2.2 keeps after its solver is gone.

        A solve for no columns replaces it with less. As the first solve, it would crash.
        """
        nothing, result = np.empty((n, 0)), np.empty((n, 0))
        weakref.finalize(self, self._solver.solve, nothing, result).atexit = False
