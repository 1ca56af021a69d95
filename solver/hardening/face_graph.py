# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles as the nodes of a graph, neighbors where they share an edge."""

import numpy as np
import scipy.sparse as sp

from ..mesh.triangles import Triangles

_SHORTEST = 1e-9  # in the unit box, between two centroids


class FaceGraph:
    """The neighbors of the triangles of a surface.

    Parameters
    ----------
    V : (n,3) float array
        Positions in the unit box.
    F : (m,3) int array

    Attributes
    ----------
    areas, normals
        As of `Triangles`.
    one, other : (k,) int arrays
        Pairs of triangles that share an edge.
    length : (k,) array
        Of that edge.
    distance : (k,) array
        Between the centroids, by way of the middle of the edge.
    """

    def __init__(self, V, F):
        triangles = Triangles(V, F)
        self.areas, self.normals = triangles.areas, triangles.normals
        self.one, self.other, edge = triangles.edges.pairs()
        self._centroids = V[F].mean(axis=1)
        ends = V[triangles.edges.lower[edge]], V[triangles.edges.upper[edge]]
        middle = 0.5 * (ends[0] + ends[1])
        self.length = np.linalg.norm(ends[1] - ends[0], axis=1)
        ways = [
            np.linalg.norm(self._centroids[at] - middle, axis=1) for at in (self.one, self.other)
        ]
        self.distance = np.maximum(ways[0] + ways[1], _SHORTEST)

    def symmetric(self, values):
        """Return values (k,) of the pairs as csr_matrix (m,m)."""
        m = len(self.areas)
        ends = np.concatenate([self.one, self.other]), np.concatenate([self.other, self.one])
        return sp.csr_matrix((np.concatenate([values, values]), ends), shape=(m, m))

    def is_convex(self, normals):
        """Return over which pairs (k,) a surface with normals (m,3) bends outward."""
        apart = self._centroids[self.other] - self._centroids[self.one]
        bend = normals[self.other] - normals[self.one]
        return np.einsum("kj,kj->k", apart, bend) > 0.0
