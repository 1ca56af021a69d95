# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles as the nodes of a graph, neighbors where they share an edge."""

from functools import cached_property

import numpy as np
import scipy.sparse as sp

from ..algebra import by_blocks
from .components import components
from .edges import Triangles

_SHORTEST = 1e-9  # in the unit box, between two centroids


class FaceGraph:
    """The neighbors of the triangles of a surface.

    `V`: (n,3) float, positions in the unit box. `F`: (m,3) int.

    `areas`, `normals`, `edges`: as of `Triangles`. `one`, `other`, `edge`: (k,) int, pairs of
    triangles that share an edge, and its number; of several, one of them. `length`: (k,), of that
    edge. `distance`: (k,), between the centroids, by way of the middle of the edge.
    """

    def __init__(self, V, F):
        triangles = Triangles(V, F)
        self.edges = triangles.edges
        self.areas, self.normals = triangles.areas, triangles.normals
        self.one, self.other, self.edge = _distinct(*triangles.edges.pairs(), len(F))
        self._centroids = by_blocks(lambda F: V[F].mean(axis=1), F)
        ends = V[triangles.edges.lower[self.edge]], V[triangles.edges.upper[self.edge]]
        middle = 0.5 * (ends[0] + ends[1])
        self.length = np.linalg.norm(ends[1] - ends[0], axis=1)
        ways = [
            np.linalg.norm(self._centroids[at] - middle, axis=1) for at in (self.one, self.other)
        ]
        self.distance = np.maximum(ways[0] + ways[1], _SHORTEST)

    @cached_property
    def _pattern(self):
        """The csr_matrix (m,m) with the number of each entry among pairs, pairs and triangles."""
        m = len(self.areas)
        own = np.arange(m, dtype=np.int32)
        one, other = self.one.astype(np.int32), self.other.astype(np.int32)
        ends = np.concatenate([one, other, own]), np.concatenate([other, one, own])
        # counted from 1, as sparse matrices drop zeros
        numbers = np.arange(1, len(ends[0]) + 1)
        return sp.csr_matrix((numbers, ends), shape=(m, m))

    def matrix(self, values, diagonal):
        """Return the symmetric csr_matrix (m,m) of values (k,) of pairs, and the diagonal (m,)."""
        pattern = self._pattern
        data = np.concatenate([values, values, diagonal])[
            np.asarray(pattern.data, dtype=np.intp) - 1
        ]
        return sp.csr_matrix((data, pattern.indices, pattern.indptr), shape=pattern.shape)

    def sums(self, values):
        """Return the sums (m,) of values (k,) of the pairs of each triangle."""
        m = len(self.areas)
        return np.bincount(self.one, values, m) + np.bincount(self.other, values, m)

    def regions(self, is_joined):
        """Return the number of regions, and that of each triangle (m,), joined by pairs (k,)."""
        pairs = np.stack([self.one[is_joined], self.other[is_joined]], axis=1)
        return components(pairs, len(self.areas))

    def regions_of_sides(self, side):
        """Return the `regions` of a side (m,) int each; a triangle with a negative one is one."""
        return self.regions((side[self.one] == side[self.other]) & (side[self.one] >= 0))

    def is_convex(self, normals):
        """Return over which pairs (k,) a surface with normals (m,3) bends outward."""
        centroids = self._centroids

        def is_convex(one, other):
            apart, bend = centroids[other] - centroids[one], normals[other] - normals[one]
            return np.einsum("kj,kj->k", apart, bend) > 0.0

        return by_blocks(is_convex, self.one, self.other)

    def distances(self, values):
        """Return how far apart values (m,3) of the triangles of each pair are, (k,)."""
        return by_blocks(
            lambda one, other: np.linalg.norm(values[one] - values[other], axis=1),
            *(self.one, self.other),
        )


def _distinct(one, other, edge, m):
    """Return pairs of triangles once each, and none of a triangle with itself."""
    key = np.minimum(one, other).astype(np.int64) * m + np.maximum(one, other)
    _, first = np.unique(key, return_index=True)
    first = first[one[first] != other[first]]
    return one[first], other[first], edge[first]
