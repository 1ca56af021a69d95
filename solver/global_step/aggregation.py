# SPDX-License-Identifier: GPL-3.0-or-later
"""The coarser levels of algebraic multigrid, by smoothed aggregation.

Vanek, Mandel and Brezina, "Algebraic multigrid by smoothed aggregation for second and fourth order
elliptic problems" (1996). pyamg finds the aggregates; its own hierarchy is built in block matrices,
which takes three times as long.
"""

import numpy as np
import scipy.sparse as sp

from ..optional_packages import optional_package

_SMOOTHING = 4.0 / 3.0  # of the prolongation, in parts of Gershgorin's bound of each row


def aggregates(A):
    """Return disjoint groups of coupled unknowns: the number (n,) of each one's group.

    A : (n,n) csr_matrix
        Symmetric; only its pattern counts. What is coupled to nothing is a group of its own.
    """
    members = _members(A)
    is_member = np.diff(members.indptr) > 0
    group = np.full(A.shape[0], -1)
    group[is_member] = members.indices
    group[~is_member] = members.shape[1] + np.arange(np.count_nonzero(~is_member))
    return group


def _members(A):
    pyamg = optional_package("pyamg")
    return pyamg.aggregation.aggregate.standard_aggregation(sp.csr_array(A))[0]


def aggregated(A):
    """Return a prolongation from a coarser level, and the matrix of that level.

    `A`: (n,n) csr_matrix, symmetric, with a positive diagonal. Returns `P`: (n,k) csr_matrix, rows
    of vertices that are not coupled to any other are zero; `coarse`: (k,k) csr_matrix, P'AP. With
    no aggregate at all, a single row that P leaves alone.
    """
    members = _members(A)
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
