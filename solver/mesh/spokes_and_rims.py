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

from ..aliases import FloatArray, IntArray
from ..values import Value
from .edge_vectors import edge_vectors
from .edges import Edges, stable_order


@dataclass(frozen=True, eq=False, repr=False)
class SpokesAndRims(Value):
    """Rows are vertices, columns their neighbors and themselves; all arrays share one pattern."""

    indptr: IntArray
    """(n+1,) int32"""
    indices: IntArray
    """(nnz,) int32, ascending in each row"""
    laplacian: FloatArray
    """(nnz,) L[i,j]"""
    gather: FloatArray
    """(nnz,3) H_c[i,j] for the local step"""

    @property
    def scatter(self):
        """(nnz,3) H_c[j,i] for the global step."""
        # the entries in the order of their columns, and in each of their rows
        numbers = self.matrix(np.arange(len(self.indices))).tocsc().data
        return self.gather.take(np.asarray(numbers, dtype=np.intp), axis=0)

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
        del row, column
        order = np.argsort(key, kind="stable")
        ordered = key[order]
        del key
        starts = np.flatnonzero(np.append(True, ordered[1:] != ordered[:-1]))
        own = np.repeat(np.arange(n), np.diff(self.indptr)) * n + self.indices
        keys = ordered[starts]
        del ordered
        at = np.searchsorted(own, keys)
        is_new = own[np.minimum(at, len(own) - 1)] != keys
        merged = np.insert(own, at[is_new], keys[is_new])
        place = np.searchsorted(merged, keys)
        is_own = np.ones(len(merged), dtype=bool)
        is_own[place[is_new]] = False
        source = np.cumsum(is_own) - 1  # in the order of memory: twice as fast as by a mask

        def added(values, more):
            result = values.take(source, axis=0, mode="clip")
            result[place[is_new]] = 0.0
            result[place] += np.add.reduceat(more.take(order, axis=0), starts, axis=0)
            return result

        indices = (merged % n).astype(np.int32)
        indptr = np.searchsorted(merged, np.arange(n + 1, dtype=np.int64) * n).astype(np.int32)
        laplacian, gather = added(self.laplacian, laplacian), added(self.gather, gather)
        return SpokesAndRims(indptr, indices, laplacian, gather)

    def covariances(self, U, rows=slice(None)):
        """Return S_i of the positions U (n,3), for some vertices (k,): (k,3,3)."""
        begin, count = self.indptr[:-1][rows], np.diff(self.indptr)[rows]
        ends = np.append(0, np.cumsum(count))
        at = np.arange(ends[-1]) + np.repeat(begin - ends[:-1], count)
        indices, shape = self.indices[at], (len(begin), len(U))
        gather = np.ascontiguousarray(self.gather[at].T)
        return np.stack([sp.csr_matrix((x, indices, ends), shape=shape) @ U for x in gather], 1)


def spokes_and_rims(V, F, C, edges=None):
    """Build the matrices from rest positions V (n,3), triangles F (m,3) and cotangents C (m,3).

    The row sums of all of them vanish (L_f has that kernel, so the g_fk of a triangle cancel out),
    hence entries are only summed for pairs of vertices, and the diagonal follows. An edge from a
    vertex to itself drops out; its length is zero.

    `edges`: Edges of F, optional; without them they are searched for.
    """
    if edges is None:
        edges = Edges(F, len(V))
    pattern = Pattern(edges, len(V))
    weights = np.ascontiguousarray(C.T)
    weight = pattern.sum_at_edges(weights)
    laplacian = pattern.filled(-weight, -weight)
    above, below = np.empty((2, len(weight), 3))
    g_lower, g_upper = np.empty((2, *weights.shape))
    for c in range(3):
        # L_f V from the edge vectors: no precision is lost far from the origin
        for block, vectors in edge_vectors(V[:, c : c + 1], F):
            flux = vectors[:, 0] * weights[:, block]
            g_start, g_end = flux[[2, 0, 1]] - flux, flux - flux[[1, 2, 0]]
            is_backward = edges.is_backward[:, block]
            g_lower[:, block] = np.where(is_backward, g_end, g_start)  # pyright: ignore[reportIndexIssue]
            g_upper[:, block] = np.where(is_backward, g_start, g_end)  # pyright: ignore[reportIndexIssue]
        below[:, c], above[:, c] = pattern.sum_at_edges(g_lower), pattern.sum_at_edges(g_upper)
    del g_lower, g_upper
    return SpokesAndRims(pattern.indptr, pattern.indices, laplacian, pattern.filled(above, below))


class Pattern:
    """The places in a sparse matrix of the pairs of vertices that share an edge.

    `edges`: Edges. `n`: int, number of vertices.
    """

    def __init__(self, edges, n):
        is_proper = edges.lower != edges.upper
        self._lower, self._upper = edges.lower, edges.upper
        self._edge = edges.number.ravel()
        if not is_proper.all():
            self._lower, self._upper = self._lower[is_proper], self._upper[is_proper]
            number = np.where(is_proper, np.cumsum(is_proper) - 1, len(self._lower))
            self._edge = number[self._edge]
        self._find_places(n)

    def _find_places(self, n):
        """Order the entries by rows: lower neighbors, the diagonal, upper neighbors."""
        lower, upper = self._lower, self._upper
        count = np.arange(len(lower))
        left, right = np.bincount(upper, minlength=n), np.bincount(lower, minlength=n)
        indptr = np.concatenate([[0], np.cumsum(left + 1 + right)])
        self.diagonal = indptr[:-1] + left
        above = count + np.repeat(self.diagonal + 1 - (np.cumsum(right) - right), right)
        below = count + np.repeat(indptr[:-1] - (np.cumsum(left) - left), left)
        self._source = np.empty(indptr[-1], dtype=np.intp)
        self._source[above] = count
        self._source[below] = len(count) + stable_order(upper, n)
        self._source[self.diagonal] = 2 * len(count) + np.arange(n)
        self.indices = self._placed(upper, lower, np.arange(n, dtype=np.int32))
        self.indptr = indptr.astype(np.int32)

    def matrix(self, values):
        """Return values (nnz,) as csr_matrix (n,n)."""
        n = len(self.diagonal)
        return sp.csr_matrix((values, self.indices, self.indptr), shape=(n, n))

    def sum_at_edges(self, values):
        """Return the sums over the sides (3,m) of triangles that are the same edge."""
        sums = np.bincount(self._edge, values.ravel(), len(self._lower))
        return sums[: len(self._lower)]

    def filled(self, above, below):
        """Return values (nnz,...) from those off the diagonal, (e,...); rows sum to 0."""
        return self._placed(above, below, -self._row_sums(above, below))

    def _placed(self, above, below, diagonal):
        # taken in the order of memory: several times as fast as putting them there
        return np.concatenate([above, below, diagonal]).take(self._source, axis=0)

    def _row_sums(self, above, below):
        n = len(self.diagonal)
        if above.ndim > 1:
            columns = zip(above.T, below.T, strict=True)
            return np.stack([self._row_sums(*column) for column in columns], axis=1)
        return np.bincount(self._lower, above, n) + np.bincount(self._upper, below, n)
