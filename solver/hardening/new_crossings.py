# SPDX-License-Identifier: GPL-3.0-or-later
"""What comes to cross as vertices move a little."""

import numpy as np

from ..contacts.crossings import Watched, boxes
from ..contacts.polygons import are_apart


class NewCrossings:
    """The triangles that cross others at positions between two, but not at the first.

    `U`, `X`: (n,3), the two positions. `F`: (m,3) int. `is_moved`: (m,) bool, triangles that move.
    `faces`: (m,) int or None, the polygon that each triangle is a piece of. Polygons that share a
    corner are not looked at, as triangles are not: how they are split is not seen. `part`: (n,) int
    or None, connected parts of the vertices: of two that cross at first, such as a knob in a door,
    none is looked at.
    """

    def __init__(self, U, X, F, is_moved, faces, part=None):
        self._m, self._part = len(F), None if part is None else part[F[:, 0]]
        (low, high), (other_low, other_high) = boxes(U, F), boxes(X, F)
        low, high = np.minimum(low, other_low), np.maximum(high, other_high)
        self._watched = Watched(F, low, high, is_moved, are_apart(faces, F))
        pairs = self._watched.crossings(U)
        self._before, self._parts_before = self._keys(pairs), self._parts(pairs)

    def at(self, X):
        """Return the triangles (k,) int, some twice, that cross at positions X (n,3)."""
        pairs = self._watched.crossings(X)
        is_new = ~np.isin(self._keys(pairs), self._before)
        if len(self._parts_before):
            parts = self._parts(pairs)
            is_new &= (parts < 0) | ~np.isin(parts, self._parts_before)
        return pairs[is_new].ravel()

    def _keys(self, pairs):
        return pairs[:, 0] * self._m + pairs[:, 1]

    def _parts(self, pairs):
        """Return keys (k,) of the two parts of pairs (k,2), -1 where it is one."""
        if self._part is None:
            return np.empty(0, np.intp)
        one, other = np.sort(self._part[pairs], axis=1).T
        return np.where(one == other, -1, one * self._m + other)

