# SPDX-License-Identifier: GPL-3.0-or-later
"""An approximate solution of the global step for meshes too large for a factorization.

The local-global iteration needs no exact solve: any positive definite matrix above the Laplacian
makes it descend, and has the same fixed points. One V-cycle of algebraic multigrid by smoothed
aggregation (Vanek, Mandel and Brezina, 1996) is near enough to the inverse that the iteration takes
about a third more steps, and its set-up takes time and memory in proportion to the mesh, which is
less than the Cholesky factorization takes of large ones (figures: `docs/benchmarks_explained.md`).
pyamg finds the aggregates; its own hierarchy is built in block matrices, which takes three times as
long.

With Taichi the cycle runs in its kernels on all cores; on a GPU two in a row, see
`backends/taichi_cycle.py`.
"""

from functools import cached_property

import numpy as np
import scipy.sparse as sp

from ..optional_packages import optional_package
from .factorization import factorize

_COARSEST = 1000  # unknowns; so few are solved exactly
_SMOOTHING = 4.0 / 3.0  # of the prolongation, in parts of Gershgorin's bound of each row
_SMOOTHED_PART = 4.0  # the smoother damps the upper end of the spectrum, down to this fraction


def has_multigrid():
    """Return whether the package pyamg, which builds the hierarchy, is installed."""
    return optional_package("pyamg") is not None


class Multigrid:
    """One V-cycle, as an approximate inverse of a sparse positive definite matrix.

    The corrections are computed in 32 bit; what they correct is not. `backends/taichi_cycle.py`
    does the same with all cores.

    `A`: (n,n) csr_matrix, symmetric. `decoupled`: (n,n) csr_matrix, the same without coupling to
    the held rows: positive definite. `held`: (k,) int, rows of the solution that stay as they are
    given.

    `levels`: list of Level, all but the coarsest, from fine to coarse. The matrix of each is scaled
    on both sides to a diagonal of ones. `scale`: (n,) float32, factor of the residual before the
    cycle, and of the correction after it; 0 for held rows. `coarsest`: csr_matrix, the scaled
    matrix of the coarsest level.
    """

    def __init__(self, A, decoupled, held):
        self._A = A
        self.levels = []
        matrix, scale = decoupled, _root_scale(decoupled)
        self.scale = scale.astype(np.float32)
        self.scale[held] = 0.0
        while len(scale) > _COARSEST:
            P, coarse = aggregated(matrix)
            coarse_scale = _root_scale(coarse)
            P = _scaled(P, 1.0 / scale, coarse_scale)
            self.levels.append(Level(_scaled(matrix, scale, scale), P, scale))
            matrix, scale = coarse, coarse_scale
        self.coarsest = _scaled(matrix, scale, scale)

    def solve(self, B, near):
        """Return X (n,3), nearer to A X = B than the given one (n,3)."""
        residual = (B.T - _product(self._A, np.ascontiguousarray(near.T))) * self.scale
        return near + (self.scale * self._cycle(residual.astype(np.float32), 0)).T

    def _cycle(self, B, depth):
        if depth == len(self.levels):
            return self._solve_coarsest(B.T.astype(np.float64)).T.astype(np.float32)
        level = self.levels[depth]
        X = level.smooth(B)
        residual = _product(level.restrict, B - _product(level.A, X))
        X += _product(level.P, self._cycle(residual, depth + 1))
        X += level.smooth(B - _product(level.A, X))
        return X

    @cached_property
    def _solve_coarsest(self):
        return factorize(self.coarsest)


class Level:
    """One level of the hierarchy but the coarsest.

    `A`: (n,n) csr_matrix, with a diagonal of ones. `P`: (n,k) csr_matrix, prolongation from the
    next level. `scale`: (n,), what A was multiplied by on both sides.

    A, P and its transpose `restrict` are in 32 bit. The smoother is of_b B + of_ab A B, the
    Chebyshev polynomial of degree 2 that damps the upper end of the spectrum.
    """

    def __init__(self, A, P, scale):
        self.A, self.P = A.astype(np.float32), P.astype(np.float32)
        self.restrict = self.P.T.tocsr()
        # Gershgorin's bound of the spectrum, from the matrix scaled on one side
        greatest = float((scale * (abs(A) @ (1.0 / scale))).max())
        least = greatest / _SMOOTHED_PART
        center, radius = (greatest + least) / 2, (greatest - least) / 2
        second = 1 / (2 * center / radius - radius / center)
        of_rest = 2 * second / radius
        self.of_b = np.float32((1 + second * radius / center) / center + of_rest)
        self.of_ab = np.float32(-of_rest / center)

    def smooth(self, B):
        """Return the smoothed B (3,n)."""
        return self.of_b * B + self.of_ab * _product(self.A, B)


def aggregates(A):
    """Return disjoint groups of coupled unknowns: the number (n,) of each one's group.

    `A`: (n,n) csr_matrix, symmetric; only its pattern counts. What is coupled to nothing is a group
    of its own.
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


def _root_scale(A):
    return 1.0 / np.sqrt(A.diagonal())


def _scaled(A, left, right):
    """Return diag(left) A diag(right) as csr_matrix."""
    data = A.data * np.repeat(left, np.diff(A.indptr)) * right[A.indices]
    return sp.csr_matrix((data, A.indices, A.indptr), shape=A.shape)


def _product(A, X):
    """Return A X for X (3,n): SciPy is twice as fast column by column."""
    return np.stack([A @ x for x in X])
