# SPDX-License-Identifier: GPL-3.0-or-later
"""Spokes between vertices that share no triangle.

A link ties a vector d = sum_k c_k v_k at rest, whose coefficients c sum to zero, to the rotations
of its vertices, as an edge of a triangle is tied:

    E = sum_k w_k/2 |R_k d - d~|^2,    d~ = sum_k c_k u_k

Between two vertices c is (-1, 1); from a vertex to a point of a triangle it is (-1, b_1, b_2, b_3)
with the barycentric coordinates of the point. In the normalization of `spokes_and_rims.py`

    L += W/3 c c',    H[k,l] += w_k d c_l,    W = sum_k w_k

so that links change neither the steps nor the proof that the energy falls.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..aliases import FloatArray, IntArray
from ..values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Links(Value):
    """`k` links between up to four vertices each; unused ones have the coefficient 0."""

    vertices: IntArray
    """(k,4) int"""
    coefficients: FloatArray
    """(k,4) float64, each row sums to 0"""
    weights: FloatArray
    """(k,4) float64 weight of the rotation at each vertex, not negative"""

    def __len__(self):
        return len(self.vertices)

    def scaled(self, factor):
        """Return the links with scaled weights; none for a factor of 0."""
        return replace(self, weights=factor * self.weights) if factor > 0.0 else no_links()

    def weighted(self, factors):
        """Return the links with their weights multiplied by factors (k,)."""
        return replace(self, weights=factors[:, None] * self.weights)

    def mapped(self, number):
        """Return the links with their vertices mapped by number (n,)."""
        return replace(self, vertices=number[self.vertices])

    def part(self, rows):
        """Return some of the links, by number or by a mask (k,)."""
        return Links(self.vertices[rows], self.coefficients[rows], self.weights[rows])

    def joined(self, other):
        """Return these links and others."""
        return Links(
            np.concatenate([self.vertices, other.vertices]),
            np.concatenate([self.coefficients, other.coefficients]),
            np.concatenate([self.weights, other.weights]),
        )

    def pairs(self):
        """Return pairs (p,2) of vertices that connect everything that is linked."""
        used = self.coefficients[:, 1:] != 0.0
        first = np.broadcast_to(self.vertices[:, :1], used.shape)
        return np.stack([first[used], self.vertices[:, 1:][used]], axis=1)

    def entries(self, V):
        """Return what the links add to the matrices of `spokes_and_rims`.

        `V`: (n,3), rest positions. Returns `row`, `column`: (e,) int; `laplacian`: (e,); `gather`:
        (e,3).
        """
        c, w = self.coefficients, self.weights
        d = np.einsum("kj,kjx->kx", c, V[self.vertices])
        is_used = c != 0.0
        both = is_used[:, :, None] & is_used[:, None, :]

        def of_pairs(values, axis=2):
            return np.broadcast_to(np.expand_dims(values, axis), both.shape)[both]

        factor = of_pairs(c, 1)
        whole = np.broadcast_to(w.sum(axis=1, keepdims=True) / 3.0, c.shape)
        laplacian = of_pairs(whole) * (of_pairs(c) * factor)
        gather = np.repeat(d, np.count_nonzero(both, axis=(1, 2)), axis=0)
        gather *= (of_pairs(w) * factor)[:, None]
        return of_pairs(self.vertices), of_pairs(self.vertices, 1), laplacian, gather


def no_links():
    """Return a set of no links."""
    return Links(np.empty((0, 4), np.int64), np.empty((0, 4)), np.empty((0, 4)))


def links_between(i, j, weights):
    """Return links between vertices i (k,) and j (k,), with a weight (k,) at each of both ends."""
    zeros = np.zeros(len(i))
    return Links(
        np.stack([i, j, i, i], axis=1),
        np.stack([zeros - 1.0, zeros + 1.0, zeros, zeros], axis=1),
        np.stack([weights, weights, zeros, zeros], axis=1),
    )


def links_to_triangles(i, corners, barycentric, weights):
    """Return links from vertices i (k,) to points of triangles with corners (k,3).

    Half of the weight (k,) belongs to the vertex, half to the corners, by their
    barycentric coordinates (k,3).
    """
    return Links(
        np.concatenate([i[:, None], corners], axis=1),
        np.concatenate([np.full((len(i), 1), -1.0), barycentric], axis=1),
        0.5 * weights[:, None] * np.concatenate([np.ones((len(i), 1)), barycentric], axis=1),
    )
