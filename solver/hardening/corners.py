# SPDX-License-Identifier: GPL-3.0-or-later
"""What the triangles of a surface pull at their corners.

With the cotangent Laplacian L_f of a triangle, values x at its corners pull there by L_f x; the sum
of that over all triangles is L x.
"""

import numpy as np
import scipy.sparse as sp

from ..algebra import by_blocks
from ..mesh.edges import stable_order
from ..mesh.spokes_and_rims import Pattern


class Corners:
    """The corners of the triangles of a surface.

    `F`: (m,3) int. `cotangents`: (m,3), weight of the edge opposite each corner. `edges`: those of
    F. `n`: number of vertices.
    """

    def __init__(self, F, cotangents, edges, n):
        self.F, self.cotangents, self.n = F, cotangents, n
        self._pattern = Pattern(edges, n)
        at, ones = F.ravel(), np.ones(F.size)
        self._order, self._ones = stable_order(at, n), ones
        self._ends = np.append(0, np.cumsum(np.bincount(at, minlength=n))).astype(np.int32)

    def pulls(self, values):
        """Return L_f x of values x (m,3,...) at the corners."""
        return by_blocks(pulls, self.cotangents, values)

    def sums(self, values):
        """Return the sums (n,d) of values (m,3,d) at the corners of each vertex."""
        return self._summed(self._order, values.reshape(self.F.size, -1))

    def sums_around(self, values):
        """Return the sums (n,d) of values (m,d) of the triangles around each vertex."""
        return self._summed(self._order // 3, values)

    def last_around(self):
        """Return the last of the triangles around each vertex, (n,) int."""
        return self._order[self._ends[1:] - 1] // 3

    def _summed(self, rows, values):
        return sp.csr_matrix((self._ones, rows, self._ends), (self.n, len(values))) @ values

    def stiffness(self, weights):
        """Return sum_f w_f L_f, for weights (m,), as csr_matrix (n,n)."""
        at_edges = self._pattern.sum_at_edges((weights[:, None] * self.cotangents).T)
        values = self._pattern.filled(-at_edges, -at_edges)
        return self._pattern.matrix(values)


def pulls(cotangents, values):
    """Return L_f x of values x (k,3,...) at the corners of some triangles, by cotangents (k,3)."""
    weight = cotangents.reshape(-1, 3, *[1] * (values.ndim - 2))
    flux = [weight[:, k] * (values[:, k - 2] - values[:, k - 1]) for k in range(3)]
    return np.stack([flux[k - 1] - flux[k - 2] for k in range(3)], axis=1)
