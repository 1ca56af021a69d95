# SPDX-License-Identifier: GPL-3.0-or-later
"""How links pull at the triangles around their vertices, in equal shares."""

import numpy as np
import scipy.sparse as sp


class LinkedFaces:
    """The triangles of a RestMesh at whose vertices there are links.

    Positions times ``_of_links`` (3n,n) are what pulls at the vertices, and that times ``_around``
    (k,n) what pulls at the triangles.

    Attributes
    ----------
    faces : (k,) int array
        Their numbers.
    """

    def __init__(self, rest):
        F, n = rest.F, len(rest.V)
        row, column, _, gather = rest.links.entries(rest.V)
        row, column = (ends.astype(np.int32) for ends in (row, column))
        at = (3 * row[:, None] + np.arange(3, dtype=np.int32)).ravel(), np.repeat(column, 3)
        self._of_links = sp.csr_matrix((gather.ravel(), at), shape=(3 * n, n))
        is_linked = np.zeros(n, dtype=bool)
        is_linked[row] = True
        f, corner = np.nonzero(is_linked[F])
        self.faces, number = np.unique(f, return_inverse=True)
        shares = 1.0 / np.bincount(F.ravel(), minlength=n)[F[f, corner]]
        at = number, F[f, corner]
        self._around = sp.csr_matrix((shares, at), shape=(len(self.faces), n))

    def covariances(self, U):
        """Return what pulls at the triangles (k,3,3), at positions U (n,3)."""
        return (self._around @ (self._of_links @ U).reshape(-1, 9)).reshape(-1, 3, 3)

    def pulls(self, R):
        """Return the pulls (n,3) at the vertices, for rotations (k,3,3) of the triangles."""
        of_vertices = self._around.T @ R.swapaxes(1, 2).reshape(-1, 9)
        return self._of_links.T @ of_vertices.reshape(-1, 3)
