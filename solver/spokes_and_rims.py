# SPDX-License-Identifier: GPL-3.0-or-later
"""The spokes-and-rims ARAP energy as sparse matrices, weighted per triangle.

With the cotangent w_fe of the angle opposite edge e in triangle f, the energy is

    sum_i sum_{f at i} sum_{e in f} w_fe/2 |R_i d_e - d~_e|^2
        = 3/2 tr(V' L V) + 3/2 tr(U' L U) - sum_i tr(R_i S_i)

where L is the cotangent Laplacian and S_i = sum w_fe d_e d~_e' the covariance. Because w_fe belongs
to the triangle in the local and in the global step alike, both lower this one energy. (With the
weight of the whole edge, w_fe + w_ge, in the local step they would not: obtuse triangles then move
even at cubeness 0.)

With the rest vectors g_fk = (L_f V)_k of a triangle's corners, all that either step needs are three
sparse matrices H_c, c = x, y, z, whose entry (i,j) is the sum of g_fj[c] over the triangles f at
both i and j:

    local:   S_i[c,:]  = sum_j H_c[i,j] U[j,:]
    global:  (L U)[i,:] = 1/3 sum_c sum_j H_c[j,i] R_j[:,c]
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp


@dataclass(frozen=True)
class SpokesAndRims:
    """Rows are vertices, columns their neighbours and themselves; all arrays share one pattern."""

    indptr: np.ndarray
    """(n+1,) int32"""
    indices: np.ndarray
    """(nnz,) int32, ascending in each row"""
    laplacian: np.ndarray
    """(nnz,) L[i,j]"""
    gather: np.ndarray
    """(nnz,3) H_c[i,j] for the local step"""
    scatter: np.ndarray
    """(nnz,3) H_c[j,i] for the global step"""

    def matrix(self, values):
        """Return the values (nnz,) of the pattern as csr_matrix (n,n)."""
        n = len(self.indptr) - 1
        return sp.csr_matrix((values, self.indices, self.indptr), shape=(n, n))

    def covariances(self, U, rows=slice(None)):
        """Return S_i of the positions U (n,3), for some vertices (k,): (k,3,3)."""
        return np.stack([self.matrix(self.gather[:, c])[rows] @ U for c in range(3)], axis=1)


def spokes_and_rims(V, F, C):
    """Build the matrices from rest positions V (n,3), triangles F (m,3) and cotangents C (m,3)."""
    n = len(V)
    # L_f of each triangle: off-diagonal -C, rows sum to zero
    opposite = np.array([[0, 2, 1], [2, 0, 0], [1, 0, 0]])  # corner opposite the edge (k,l)
    L = np.empty((len(F), 3, 3))
    for k in range(3):
        for j in range(3):
            L[:, k, j] = -C[:, opposite[k, j]]
    L[:, 0, 0] = C[:, 1] + C[:, 2]
    L[:, 1, 1] = C[:, 0] + C[:, 2]
    L[:, 2, 2] = C[:, 0] + C[:, 1]
    # g_k = sum_l L[k,l] (v_l - v_k): differences, so that no precision is lost far from the origin
    corners = V[F]
    g = np.stack(
        [
            sum(L[:, k, j, None] * (corners[:, j] - corners[:, k]) for j in range(3))
            for k in range(3)
        ],
        axis=1,
    )

    # One sort finds the place of each of the 9 m entries in the pattern; the sums then go there.
    keys = np.repeat(F, 3, axis=1).ravel().astype(np.int64) * n + np.tile(F, (1, 3)).ravel()
    pattern, place = np.unique(keys, return_inverse=True)

    def assemble(values):
        return np.bincount(place, np.broadcast_to(values, L.shape).ravel(), len(pattern))

    row_ends = np.searchsorted(pattern, np.arange(n + 1, dtype=np.int64) * n)
    return SpokesAndRims(
        row_ends.astype(np.int32),
        (pattern % n).astype(np.int32),
        assemble(L),
        np.stack([assemble(g[:, None, :, c]) for c in range(3)], axis=1),
        np.stack([assemble(g[:, :, None, c]) for c in range(3)], axis=1),
    )
