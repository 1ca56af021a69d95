# SPDX-License-Identifier: GPL-3.0-or-later
"""Factorise a sparse positive definite matrix once, then solve for three columns at a time."""

import weakref

import numpy as np

from .optional_packages import optional_package


def factorize(A):
    """Return a function that maps B (n,3) float64 to X (n,3) with A X = B.

    Parameters
    ----------
    A : (n,n) csr_matrix
        Symmetric positive definite.
    """
    cholespy = optional_package("cholespy")  # about twice as fast as SciPy's LU at solving
    if cholespy is not None:
        return _cholesky(cholespy, A)
    from scipy.sparse.linalg import splu  # takes a tenth of a second to import

    lu = splu(
        A.tocsc(),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    return lu.solve


def _cholesky(cholespy, A):
    n = A.shape[0]
    solver = cholespy.CholeskySolverD(
        n,
        A.indptr.astype(np.int32),
        A.indices.astype(np.int32),
        A.data,
        cholespy.MatrixType.CSR,
    )

    def solve(B):
        X = np.empty_like(B, order="C")
        solver.solve(np.ascontiguousarray(B), X)
        return X

    # cholespy 2.2 keeps what a solve has needed, as long as B, even when the solver is gone. To
    # solve for no column at all makes it take less instead.
    free = weakref.finalize(solve, solver.solve, np.empty((n, 0)), np.empty((n, 0)))
    free.atexit = False
    return solve
