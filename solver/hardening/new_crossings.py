# SPDX-License-Identifier: GPL-3.0-or-later
"""What comes to cross as vertices move a little."""

import numpy as np
import scipy.sparse as sp

from ..contacts.crossings import Watched, boxes


class NewCrossings:
    """The triangles that cross others at positions between two, but not at the first.

    `U`, `X`: (n,3), the two positions. `F`: (m,3) int. `is_moved`: (m,) bool, triangles that move.
    `faces`: (m,) int or None, the polygon that each triangle is a piece of. Polygons that share a
    corner are not looked at, as triangles are not: how they are split is not seen.
    """

    def __init__(self, U, X, F, is_moved, faces):
        self._m = len(F)
        (low, high), (other_low, other_high) = boxes(U, F), boxes(X, F)
        low, high = np.minimum(low, other_low), np.maximum(high, other_high)
        self._watched = Watched(F, low, high, is_moved, None if faces is None else _apart(faces, F))
        self._before = self._keys(self._watched.crossings(U))

    def at(self, X):
        """Return the triangles (k,) int, some twice, that cross at positions X (n,3)."""
        pairs = self._watched.crossings(X)
        return pairs[~np.isin(self._keys(pairs), self._before)].ravel()

    def _keys(self, pairs):
        return pairs[:, 0] * self._m + pairs[:, 1]


def _apart(faces, F):
    """Return what maps pairs of triangles (k,2) to whether (k,) their polygons are apart."""
    corners = sp.csr_matrix((np.ones(F.size, bool), (np.repeat(faces, 3), F.ravel())))

    def are_apart(pairs):
        one, other = (corners[faces[each]] for each in pairs.T)
        return one.multiply(other).getnnz(axis=1) == 0

    return are_apart
