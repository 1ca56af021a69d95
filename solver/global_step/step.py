# SPDX-License-Identifier: GPL-3.0-or-later
"""The global step: positions from rotations, by one factorization per mesh and set of pins."""

from copy import copy
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from ..proxy.samples import extents
from .factorization import factorize
from .multigrid import Multigrid, has_multigrid
from .no_turning import NoTurning
from .tall_products import weighted_sum
from .upright_parts import UprightParts

FACTORIZED_VERTICES = 60_000
"""Larger components get multigrid: where a run ends as soon with either, and the more of its time
is set-up, the larger the mesh is; see `docs/benchmarks_explained.md`."""
SMALL_PARTS, LARGEST_PART, IN_SMALL_PARTS = 200, 10_000, 4
"""vertices of a part in the mean, of the largest one, and of all as a multiple of that: what is
only linked here and there is factorized in little time, and multigrid is far from its solution"""
MANY_COUPLED = 0.2
"""of the rows: to choose so many takes longer than to subtract nothing from the others"""
_CYCLES = 4
"""of multigrid, in place of the solution"""
_POINT = 1e-12  # extent in the unit box; of less, the directions of its vertices are rounding


class GlobalStep:
    """Solves L U = rhs with some vertices held.

    A component without a pinned vertex is held by one of its own, because L determines it only up
    to a translation; which one does not matter, since the component is then moved so that its
    area-weighted centroid stays where it was at rest.

    `pinned`: (k,) int, pinned vertices, as indices into ``rest.V``. `hold`: (n,), added to the
    diagonal of L: how firmly vertices are drawn to given places, which belong to the right-hand
    side. Then nothing floats.

    `is_factorized`: whether `positions` solves by the factorization, not by multigrid.
    `is_anchored`: (component_count,) bool, components that do not float, but have a pinned vertex
    or a held group. `solve`: maps B (n,3) and X (n,3) to the solution of L X = B, or to what is
    nearer to it than X; what is held stays as it is in X.
    """

    def __init__(self, rest, pinned, hold=None):
        n = len(rest.V)
        self._rest, self.hold = rest, hold
        has_pin = np.zeros(rest.topology.component_count, dtype=bool)
        has_pin[rest.topology.component[pinned]] = True
        is_held = np.zeros(n, dtype=bool)
        is_held[pinned] = True
        if hold is None:
            _, first_vertex = np.unique(rest.topology.component, return_index=True)
            is_held[first_vertex[~has_pin]] = True
        else:
            has_pin[:] = True
        self._is_held = is_held
        self.is_factorized = _is_small(rest.topology) or not has_multigrid()
        if self.is_factorized:
            self.solve = _solver(self._laplacian, is_held)
        else:
            self.solve = self.multigrid.solve
        self.is_anchored = has_pin

    @property
    def _laplacian(self):
        L = self._rest.matrices.matrix(self._rest.matrices.laplacian)
        return L if self.hold is None else (L + sp.diags(self.hold)).tocsr()

    @cached_property
    def multigrid(self):
        """The Multigrid, created on first use: if nothing is factorized, or for a GPU."""
        L, is_held = self._laplacian, self._is_held
        return Multigrid(L, decoupled(L, is_held), np.flatnonzero(is_held))

    def posed(self, rest):
        """Return the same step for another pose of the mesh, see `RestMesh.posed`."""
        other = copy(self)
        other._forget_constraints()
        other._rest = rest
        return other

    def anchored(self, components):
        """Return the same step, in which components (c,) are not kept where they are at rest."""
        other = copy(self)
        other._forget_constraints()
        other.is_anchored = self.is_anchored.copy()
        other.is_anchored[components] = True
        return other

    @cached_property
    def _may_be_kept(self):
        """(component_count,) bool array, components that float and have a rotation: no points."""
        rest = self._rest
        return ~self.is_anchored & (extents(rest.V, rest.topology.component) > _POINT)

    def _forget_constraints(self):
        names = ("_may_be_kept", "centring", "no_turning", "no_turning_by_cycles", "upright_parts")
        for name in names:
            self.__dict__.pop(name, None)

    @cached_property
    def centring(self):
        """The Centering of what floats, created on first use."""
        return Centring(self._rest, ~self.is_anchored)

    @cached_property
    def no_turning(self):
        """The NoTurning, created on first use."""
        is_whole = self._may_be_kept & ~self.upright_parts.is_kept
        return NoTurning(self._rest, is_whole, self.solution)

    @cached_property
    def no_turning_by_cycles(self):
        """Of all components, by multigrid: `TaichiMotion` has the parts obey after its kernels."""
        return NoTurning(self._rest, self._may_be_kept, self._by_cycles)

    @cached_property
    def upright_parts(self):
        """The UprightParts, created on first use."""
        return UprightParts(self._rest, self._may_be_kept, self.solution)

    def solution(self, B):
        """Return the solution X (n,3) of L X = B, or what is near it; 0 where vertices are held."""
        if not self.is_factorized:
            return self._by_cycles(B)
        return self.solve(B, np.zeros_like(B))

    def _by_cycles(self, B):
        X = np.zeros_like(B)
        for _ in range(_CYCLES):
            X = self.multigrid.solve(B, X)
        return X

    def positions(self, rhs, near, keep_rotation=False):
        """Return new positions (n,3).

        `rhs`: (n,3), right-hand side. `near`: (n,3), positions to start from, where the solution is
        iterative. Pinned vertices stay there. `keep_rotation`: bool, keep each component without
        pins from turning as a whole, and its large parts, too.
        """
        result = self.solve(rhs, near)
        if self.is_anchored.all():
            return result
        if keep_rotation:
            self.no_turning.impose(result)
            self.upright_parts.impose(result)
        self.centring.impose(result)
        return result


class Centring:
    """Keep the centroid of each floating component, weighted by area, where it is at rest.

    `rest`: RestMesh. `is_floating`: (component_count,) bool, the components that move, at least
    one; the others stay as they are, bit for bit.
    """

    def __init__(self, rest, is_floating):
        topology = rest.topology
        self._is_whole = topology.component_count == 1
        share = topology.shares(rest.weighing)
        if self._is_whole:
            self._share = share
        else:
            share = np.where(is_floating[topology.component], share, 0.0)
            self._share = topology.by_component(share[:, None]).T
            self._spread = topology.by_component(np.ones((len(share), 1)))
        self._centroids = self._measure(rest.V)

    def _measure(self, U):
        """Return the centroids (component_count,3), zero of those that do not float."""
        return weighted_sum(self._share, U)[None] if self._is_whole else self._share @ U

    def impose(self, U):
        """Move the components of positions U (n,3), in place, to where their centroids were."""
        shift = self._centroids - self._measure(U)
        if not self._is_whole:
            U += self._spread @ shift
            return
        for column, step in zip(U.T, shift[0], strict=True):
            column += step  # adding rows of three takes NumPy ten times as long


def _is_small(topology):
    largest = topology.largest_component
    if largest <= FACTORIZED_VERTICES:
        return True
    count = np.bincount(topology.part)
    is_loose = count.mean() <= SMALL_PARTS and count.max() <= LARGEST_PART
    return bool(is_loose) and largest <= IN_SMALL_PARTS * FACTORIZED_VERTICES


def _solver(L, is_held):
    """Return a function from B and X (n,3) to the solution of L X = B with the held rows of X."""
    held = np.flatnonzero(is_held)
    coupling = L[:, held]
    coupled = np.flatnonzero(np.diff(coupling.indptr))  # few: most rows have no held neighbor
    if len(coupled) > MANY_COUPLED * len(is_held):  # but where each leaf of a tree has one
        coupled = slice(None)
    coupling = coupling[coupled]
    solve = factorize(decoupled(L, is_held))

    def solve_all(B, X):
        rhs, at = B.copy(), X.take(held, axis=0)
        rhs[coupled] -= coupling @ at
        rhs[held] = at
        result = solve(rhs)
        result[held] = at
        return result

    return solve_all


def decoupled(L, is_held):
    """Return L (n,n) with the rows and columns of what is held (n,) those of the identity."""
    rows = np.repeat(np.arange(len(is_held)), np.diff(L.indptr))
    is_diagonal = rows == L.indices
    is_cleared = is_held[rows] | is_held[L.indices]
    data = np.where(is_cleared, np.where(is_diagonal, 1.0, 0.0), L.data)
    result = sp.csr_matrix((data, L.indices.copy(), L.indptr.copy()), shape=L.shape)
    result.eliminate_zeros()
    return result
