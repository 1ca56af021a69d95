# SPDX-License-Identifier: GPL-3.0-or-later
"""The coarser levels of algebraic multigrid, by smoothed aggregation.

Vanek, Mandel and Brezina, "Algebraic multigrid by smoothed aggregation for second and fourth order
elliptic problems" (1996). pyamg finds the aggregates; its own hierarchy is built in block matrices,
which takes three times as long.
"""

import numpy as np
import scipy.sparse as sp

from .optional_packages import optional_package

_SMOOTHING = 4.0 / 3.0  # of the prolongation, in parts of Gershgorin's bound of each row


def aggregated(A):
    """Return a prolongation from a coarser level, and the matrix of that level.

    Parameters
    ----------
    A : (n,n) csr_matrix
        Symmetric, with a positive diagonal.

    Returns
    -------
    P : (n,k) csr_matrix
        Rows of vertices that are not coupled to any other are zero.
    coarse : (k,k) csr_matrix
        P'AP. With no aggregate at all, a single row that P leaves alone.
    """
    pyamg = optional_package("pyamg")
    members, _ = pyamg.aggregation.aggregate.standard_aggregation(sp.csr_array(A))
    if not members.nnz:
        return sp.csr_matrix((A.shape[0], 1)), sp.identity(1, format="csr")
    T = sp.csr_matrix(members, dtype=np.float64)
    flow = A @ T
    step = _SMOOTHING / (abs(A) @ np.ones(A.shape[0]))
    flow.data *= np.repeat(step, np.diff(flow.indptr))
    P = (T - flow).tocsr()
    P.eliminate_zeros()
    P.sort_indices()
    return P, (P.T.tocsr() @ (A @ P)).tocsr()
