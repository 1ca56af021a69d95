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
    or None, of the vertices: where two parts cross at first, as a knob and a door, they may cross
    elsewhere, but for `apart`, (k,2) int, pairs of parts.
    """

    def __init__(self, U, X, F, is_moved, faces, part=None, apart=()):
        (low, high), (other_low, other_high) = boxes(U, F), boxes(X, F)
        low, high = np.minimum(low, other_low), np.maximum(high, other_high)
        self._watched = Watched(F, low, high, is_moved, are_apart(faces, F))
        self._part = None if part is None else part[F[:, 0]].astype(np.int64)
        self._m, pairs = len(F), self._watched.crossings(U)
        self._before = self._keys(pairs)
        if self._part is not None:
            parts = self._part[pairs]
            of_two = self._keys(np.sort(parts[parts[:, 0] != parts[:, 1]], axis=1))
            self._parts_before = np.setdiff1d(of_two, self._keys(np.reshape(apart, (-1, 2))))

    def at(self, X):
        """Return the triangles (k,) int, some twice, that cross at positions X (n,3).

        Two by two, those that cross each other.
        """
        pairs = self._watched.crossings(X)
        is_new = ~np.isin(self._keys(pairs), self._before)
        if self._part is not None:
            parts = self._keys(np.sort(self._part[pairs], axis=1))
            is_new &= ~np.isin(parts, self._parts_before)
        return pairs[is_new].ravel()

    def _keys(self, pairs):
        return pairs[:, 0] * self._m + pairs[:, 1]
