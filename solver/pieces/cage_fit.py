# SPDX-License-Identifier: GPL-3.0-or-later
"""Fit a cage to the smooth surface that it should have.

Least squares alone would tangle the cage: the surface hardly tells where the vertices of narrow
faces are, as around an eye. So the edges of the cage also want to be those at rest, turned as the
surface around them, and the more so the shorter they are. And the surface would ripple beside edges
that are too sharp for it, as a Fourier series does: so the cage stays near the surface.
"""

from typing import Any

import numpy as np

from ..aliases import BoolArray, FloatArray, IntArray
from ..global_step.factorization import factorize
from ..rotation_fit import svd_rotations

FIRMNESS = 0.025
"""of an edge of median length, relative to one vertex of the cage that fits everywhere"""
NEARNESS = 0.2
"""weight of a vertex of the cage that stays with the surface, relative to the same"""
DIRECTION = 3.0
"""weight of edges of the surface, relative to places of vertices: where it faces is what counts"""
FINE, FIRMEST = 500.0, 8.0
"""vertices of a cage from which on it is firmer and nearer, up to so many times: the surface of a
finer one needs less, and tells less of where narrow faces are"""
PER_VERTEX = 16.0
"""vertices of the surface for each of the cage after two levels"""
SHORTEST = 0.05
"""of the median length; shorter edges are as firm as one of this length"""


class CageFit:
    """The fit of a cage of k vertices to surfaces of N.

    `smooth`: (N,k) scipy csr_matrix, from positions of the cage to those of its surface. `edges`,
    `fine`: (e,2) and (d,2) int, the edges of the cage, and of its surface. `at_rest`: (k,3), the
    cage at rest. `is_held`: (k,) bool, vertices that are given.
    """

    def __init__(
        self, smooth: Any, edges: IntArray, fine: IntArray, at_rest: FloatArray, is_held: BoolArray
    ):
        import scipy.sparse as sp

        self._is_held = is_held
        self._smooth, self._edges, self._at_rest = smooth, edges, at_rest
        self._across, along = _differences(edges, len(at_rest)), _differences(fine, smooth.shape[0])
        both = sp.identity(smooth.shape[0]) + DIRECTION * along.T @ along
        self._fitting = (smooth.T @ both).tocsr() / (1.0 + DIRECTION)
        length = np.linalg.norm(self._across @ at_rest, axis=1)
        median = np.median(length)
        length = np.maximum(length, SHORTEST * median + 1e-300)
        fineness = smooth.shape[0] / (PER_VERTEX * len(at_rest))
        fineness *= np.clip((len(at_rest) / FINE) ** 1.5, 1.0, FIRMEST)
        firmness = FIRMNESS * fineness * (median / length) ** 4
        self._firm = (self._across.T @ sp.diags(firmness)).tocsr()
        self._near = NEARNESS * fineness
        self._surface_at_rest = smooth @ at_rest
        self._reach = np.asarray(smooth.sum(axis=0)).ravel()[:, None]
        regular = self._firm @ self._across + self._near * sp.identity(len(at_rest))
        self._matrix = (self._fitting @ smooth + regular).tocsr()
        free = np.flatnonzero(~is_held)
        self._solve = factorize(self._matrix[free][:, free].tocsr()) if len(free) else None

    def serves(self, at_rest: FloatArray, is_held: BoolArray) -> bool:
        """Return whether it is made for a cage at rest, and what is held."""
        return np.array_equal(at_rest, self._at_rest) and np.array_equal(is_held, self._is_held)

    def __call__(self, surface: FloatArray, goal: FloatArray) -> FloatArray:
        """Return the cage (k,3) of a surface (N,3), with held vertices as in a goal (k,3)."""
        cage = goal.copy()
        if self._solve is not None:
            wanted = self._turned(surface, self._across @ self._at_rest)
            right = self._fitting @ surface + self._firm @ wanted
            right += self._near * surface[: len(goal)] - self._matrix @ goal
            cage[~self._is_held] += self._solve(right[~self._is_held])
        return cage

    def _turned(self, surface, edges):
        """Return edges (e,3) of the cage at rest, turned as the surface around them."""
        before, after = self._around(self._surface_at_rest), self._around(surface)
        products = self._surface_at_rest[:, :, None] * surface[:, None, :]
        turns = self._around(products.reshape(-1, 9)).reshape(-1, 3, 3)
        turns -= before[:, :, None] * after[:, None, :]
        R = svd_rotations(turns[self._edges].sum(axis=1))
        return np.einsum("eij,ej->ei", R, edges)

    def _around(self, values):
        """Return the means (k,...) of the surface that each vertex of the cage shapes."""
        return self._smooth.T @ values / self._reach


def _differences(edges, count):
    """Return the matrix (e,count) from values at vertices to their differences along edges."""
    import scipy.sparse as sp

    ones = np.repeat([1.0, -1.0], len(edges))
    place = np.tile(np.arange(len(edges)), 2), edges.T.ravel()
    return sp.csr_matrix((ones, place), shape=(len(edges), count))
