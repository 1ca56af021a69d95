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

from .edge_vectors import edge_vectors


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

    def with_links(self, V, links):
        """Return the matrices with what links (`proxy.Links`) add, from rest positions V (n,3)."""
        if not len(links):
            return self
        n = len(self.indptr) - 1
        row, column, laplacian, gather = links.entries(V)
        key = row.astype(np.int64) * n + column
        order = np.argsort(key, kind="stable")
        ordered = key[order]
        starts = np.flatnonzero(np.append(True, ordered[1:] != ordered[:-1]))
        own = np.repeat(np.arange(n), np.diff(self.indptr)) * n + self.indices
        keys = ordered[starts]
        at = np.searchsorted(own, keys)
        is_new = own[np.minimum(at, len(own) - 1)] != keys
        merged = np.insert(own, at[is_new], keys[is_new])
        place = np.searchsorted(merged, keys)
        kept = np.ones(len(merged), dtype=bool)
        kept[place[is_new]] = False

        def added(values, more):
            result = np.zeros((len(merged), *values.shape[1:]))
            result[kept] = values
            result[place] += np.add.reduceat(more[order], starts, axis=0)
            return result

        indices = (merged % n).astype(np.int32)
        indptr = np.searchsorted(merged, np.arange(n + 1, dtype=np.int64) * n).astype(np.int32)
        gather = added(self.gather, gather)
        # the entries in the order of their columns, and in each of their rows
        numbers = sp.csr_matrix((np.arange(len(merged)), indices, indptr), shape=(n, n))
        transposed = np.asarray(numbers.tocsc().data, dtype=np.intp)
        return SpokesAndRims(
            indptr, indices, added(self.laplacian, laplacian), gather, gather[transposed]
        )

    def covariances(self, U, rows=slice(None)):
        """Return S_i of the positions U (n,3), for some vertices (k,): (k,3,3)."""
        return np.stack([self.matrix(self.gather[:, c])[rows] @ U for c in range(3)], axis=1)


def spokes_and_rims(V, F, C):
    """Build the matrices from rest positions V (n,3), triangles F (m,3) and cotangents C (m,3).

    The row sums of all of them vanish (L_f has that kernel, so the g_fk of a triangle cancel out),
    hence entries are only summed for pairs of vertices, and the diagonal follows. An edge from a
    vertex to itself drops out; its length is zero.
    """
    # the edge opposite corner k runs from corner k+1 to corner k+2
    start, end = F[:, [1, 2, 0]].astype(np.int32), F[:, [2, 0, 1]].astype(np.int32)
    is_backward = (start > end).T
    pattern = _Pattern(start.ravel(), end.ravel(), len(V))
    del start, end
    nnz = len(pattern.indices)
    weight = pattern.sum_at_edges(C)
    laplacian = pattern.fill(np.empty(nnz), -weight, -weight)
    gather, scatter = np.empty((nnz, 3)), np.empty((nnz, 3))
    g_lower, g_upper = np.empty(F.shape), np.empty(F.shape)
    for c in range(3):
        # L_f V from the edge vectors: no precision is lost far from the origin
        for block, edges in edge_vectors(V[:, c : c + 1], F):
            flux = edges[:, 0] * C[block].T
            g_start, g_end = flux[[2, 0, 1]] - flux, flux - flux[[1, 2, 0]]
            flip = is_backward[:, block]
            g_lower[block] = np.where(flip, g_end, g_start).T
            g_upper[block] = np.where(flip, g_start, g_end).T
        below, above = pattern.sum_at_edges(g_lower), pattern.sum_at_edges(g_upper)
        pattern.fill(gather[:, c], above, below)
        pattern.fill(scatter[:, c], below, above, gather[pattern.diagonal, c])
    return SpokesAndRims(pattern.indptr, pattern.indices, laplacian, gather, scatter)


class _Pattern:
    """The places in a sparse matrix of the pairs of vertices that share an edge.

    Parameters
    ----------
    start, end : (h,) int array
        Both ends of edges, which may occur any number of times.
    n : int
        Number of vertices.
    """

    def __init__(self, start, end, n):
        lower, upper = np.minimum(start, end), np.maximum(start, end)
        lower[start == end] = n  # sorted behind all others, and left out
        order, is_new = ordered_pairs(lower, upper, n + 1)
        lower, upper = lower[order], upper[order]
        self._edge = np.empty(len(order), dtype=np.intp)
        self._edge[order] = np.cumsum(is_new) - 1
        is_new &= lower < n
        self._lower, self._upper = lower[is_new], upper[is_new]
        self._find_places(n)

    def _find_places(self, n):
        """Order the entries by rows: lower neighbours, the diagonal, upper neighbours."""
        lower, upper = self._lower, self._upper
        count = np.arange(len(lower))
        left, right = np.bincount(upper, minlength=n), np.bincount(lower, minlength=n)
        indptr = np.concatenate([[0], np.cumsum(left + 1 + right)])
        self.diagonal = indptr[:-1] + left
        self._upper_place = count + np.repeat(self.diagonal + 1 - (np.cumsum(right) - right), right)
        transposed = _stable_order(upper, n)
        self._lower_place = np.empty_like(count)
        self._lower_place[transposed] = count + np.repeat(
            indptr[:-1] - (np.cumsum(left) - left), left
        )
        self.indices = np.empty(indptr[-1], dtype=np.int32)
        self.indices[self._lower_place] = lower
        self.indices[self.diagonal] = np.arange(n)
        self.indices[self._upper_place] = upper
        self.indptr = indptr.astype(np.int32)

    def sum_at_edges(self, values):
        """Return the sums over all occurrences of an edge, from values in the order given."""
        sums = np.bincount(self._edge, values.ravel(), len(self._lower))
        return sums[: len(self._lower)]

    def fill(self, values, above, below, diagonal=None):
        """Fill values (nnz,) with those above and below the diagonal, one per edge; return them.

        Without a diagonal the rows sum to zero.
        """
        if diagonal is None:
            n = len(self.diagonal)
            diagonal = -np.bincount(self._lower, above, n) - np.bincount(self._upper, below, n)
        values[self._upper_place] = above
        values[self._lower_place] = below
        values[self.diagonal] = diagonal
        return values


def ordered_pairs(lower, upper, n):
    """Return the stable order (h,) of pairs below n, and which are not as the one before in it."""
    order = _stable_order(upper, n).astype(np.intp)
    order = order[_stable_order(lower[order], n)]
    lower, upper = lower[order], upper[order]
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = (lower[1:] != lower[:-1]) | (upper[1:] != upper[:-1])
    return order, is_new


def _stable_order(keys, count):
    """Return the stable order of integer keys below count, by counting instead of comparing."""
    rows = np.arange(len(keys) + 1, dtype=np.int32)
    one_per_row = sp.csr_matrix((keys, keys, rows), shape=(len(keys), count))
    return one_per_row.tocsc().indices
