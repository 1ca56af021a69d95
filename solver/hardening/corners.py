# SPDX-License-Identifier: GPL-3.0-or-later
"""What the triangles of a surface pull at their corners.

With the cotangent Laplacian L_f of a triangle, values x at its corners pull there by L_f x; the sum
of that over all triangles is L x.
"""

import numpy as np

from ..algebra import sums_by_group
from ..mesh.spokes_and_rims import Pattern


class Corners:
    """The corners of the triangles of a surface.

    `F`: (m,3) int. `cotangents`: (m,3), weight of the edge opposite each corner. `edges`: those of
    F. `n`: number of vertices.
    """

    def __init__(self, F, cotangents, edges, n):
        self.F, self._C, self.n = F, cotangents, n
        self._pattern = Pattern(edges, n)

    def pulls(self, values):
        """Return L_f x of values x (m,3,...) at the corners."""
        weight = self._C.reshape(-1, 3, *[1] * (values.ndim - 2))
        flux = [weight[:, k] * (values[:, k - 2] - values[:, k - 1]) for k in range(3)]
        return np.stack([flux[k - 1] - flux[k - 2] for k in range(3)], axis=1)

    def sums(self, values):
        """Return the sums (n,d) of values (m,3,d) at the corners of each vertex."""
        at = self.F.ravel()
        flat = values.reshape(len(at), -1)
        return sums_by_group(flat, at, self.n)

    def stiffness(self, weights):
        """Return sum_f w_f L_f, for weights (m,), as csr_matrix (n,n)."""
        at_edges = self._pattern.sum_at_edges((weights[:, None] * self._C).T)
        values = self._pattern.filled(-at_edges, -at_edges)
        return self._pattern.matrix(values)
