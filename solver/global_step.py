# SPDX-License-Identifier: GPL-3.0-or-later
"""The global step: positions from rotations, by one factorisation per mesh and set of pins."""

import numpy as np

from .errors import CubicCraftError
from .factorization import factorize
from .multigrid import Multigrid, has_multigrid

FACTORIZED_VERTICES = 200_000
"""Larger meshes get multigrid. The factorisation of one of 400 k takes four times its set-up."""


class GlobalStep:
    """Solves L U = rhs with some vertices held.

    A component without a pinned vertex is held by one of its own, because L determines it only up
    to a translation; which one does not matter, since the component is then moved so that its
    area-weighted centroid stays where it was at rest.

    Parameters
    ----------
    rest : RestMesh
    pinned : (k,) int array
        Pinned vertices, as indices into ``rest.V``.

    Raises
    ------
    CubicCraftError
        All vertices are pinned.
    """

    def __init__(self, rest, pinned):
        n = len(rest.V)
        self.pinned = pinned
        self._rest = rest
        has_pin = np.zeros(rest.component_count, dtype=bool)
        has_pin[rest.component[pinned]] = True
        is_held = np.zeros(n, dtype=bool)
        is_held[pinned] = True
        if is_held.all():
            raise CubicCraftError("all vertices are pinned; leave some of them free")
        _, first_vertex = np.unique(rest.component, return_index=True)
        is_held[first_vertex[~has_pin]] = True
        self._free = np.flatnonzero(~is_held)
        self._held = np.flatnonzero(is_held)
        L = rest.matrices.matrix(rest.matrices.laplacian)
        free_rows = L[self._free]
        self._coupling = free_rows[:, self._held]
        self._solve = _solver(free_rows[:, self._free]) if len(self._free) else None
        self._floating = None if has_pin.all() else self._centring_weights(has_pin)

    def _centring_weights(self, has_pin):
        """Return the share of each vertex (n,) in its floating component's area, else 0."""
        rest = self._rest
        weight = np.where(has_pin[rest.component], 0.0, rest.areas + 1e-300)
        total = np.bincount(rest.component, weight, rest.component_count)
        return weight / np.where(total > 0.0, total, 1.0)[rest.component]

    def positions(self, rhs, near):
        """Return new positions (n,3).

        Parameters
        ----------
        rhs : (n,3) array
            Right-hand side.
        near : (n,3) array
            Positions to start from, where the solution is iterative. Pinned vertices stay there.
        """
        result = near.copy()
        if self._solve is None:
            return result
        free_rhs = rhs[self._free] - self._coupling @ near[self._held]
        result[self._free] = self._solve(free_rhs, near[self._free])
        if self._floating is not None:
            self._centre(result, self._floating)
        return result

    def _centre(self, U, weight):
        rest = self._rest
        offset = weight[:, None] * (rest.V - U)
        if rest.component_count == 1:
            U += offset.sum(axis=0)
            return
        shift = np.stack(
            [np.bincount(rest.component, offset[:, c], rest.component_count) for c in range(3)],
            axis=1,
        )
        moving = weight > 0.0
        U[moving] += shift[rest.component[moving]]


def _solver(A):
    """Return a function of B (n,3) and X (n,3): the solution of A X = B, or one nearer to it."""
    if A.shape[0] > FACTORIZED_VERTICES and has_multigrid():
        return Multigrid(A).solve
    solve = factorize(A)
    return lambda B, near: solve(B)
