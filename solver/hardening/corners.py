# SPDX-License-Identifier: GPL-3.0-or-later
"""What the triangles of a surface pull at their corners.

With the cotangent Laplacian L_f of a triangle, values x at its corners pull there by L_f x; the sum
of that over all triangles is L x.
"""

import numpy as np
import scipy.sparse as sp


class Corners:
    """The corners of the triangles of a surface.

    Parameters
    ----------
    F : (m,3) int array
    cotangents : (m,3) array
        Weight of the edge opposite each corner.
    n : int
        Number of vertices.
    """

    def __init__(self, F, cotangents, n):
        self.F, self._C, self.n = F, cotangents, n

    def pulls(self, values):
        """Return L_f x of values x (m,3,...) at the corners."""
        found = np.zeros_like(values)
        for k in range(3):
            a, b = (k + 1) % 3, (k + 2) % 3
            weight = self._C[:, k].reshape(-1, *[1] * (values.ndim - 2))
            flux = weight * (values[:, a] - values[:, b])
            found[:, a] += flux
            found[:, b] -= flux
        return found

    def sums(self, values):
        """Return the sums (n,d) of values (m,3,d) at the corners of each vertex."""
        at = self.F.ravel()
        flat = values.reshape(len(at), -1)
        return np.stack([np.bincount(at, x, self.n) for x in flat.T], axis=1)

    def stiffness(self, weights):
        """Return sum_f w_f L_f, for weights (m,), as csr_matrix (n,n)."""
        w = (weights[:, None] * self._C).T
        i, j = self.F.T[[1, 2, 0]].ravel(), self.F.T[[2, 0, 1]].ravel()
        w = w.ravel()
        entries = np.concatenate([-w, -w, w, w])
        at = np.concatenate([i, j, i, j]), np.concatenate([j, i, i, j])
        return sp.csr_matrix((entries, at), shape=(self.n, self.n))
