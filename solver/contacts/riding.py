# SPDX-License-Identifier: GPL-3.0-or-later
"""Cards ride on what they lie on, where some of them would go through it.

Hair keeps its place over the nearest point of the head, turned as the head is there. So it does not
come to lie below the skin, and holds nothing: the head is as cubic as it is without hair. All cards
of a figure do so, as those that become flat on their own stand out between the others.
"""

from dataclasses import dataclass

import numpy as np

from ..algebra import BLOCK
from ..aliases import FloatArray, IntArray
from ..proxy.closest_point import closest_points
from ..proxy.nearest import Nearest
from ..rotation_fit import svd_rotations

_CANDIDATES = 6  # triangles, by their centers, among which the nearest is searched


@dataclass(frozen=True, eq=False)
class Riding:
    """The vertices that ride, and where."""

    vertices: IntArray
    """(k,) int"""
    corners: IntArray
    """(k,3) int of the triangle that each rides on"""
    barycentric: FloatArray
    """(k,3) of the point of it that is nearest at rest"""
    offsets: FloatArray
    """(k,3) from there, at rest"""

    def turned(self, R: FloatArray) -> FloatArray:
        """Return rotations (n,3,3) in which these vertices turn as what they ride on."""
        mixed = np.einsum("kc,kcij->kij", self.barycentric, R[self.corners])
        R = R.copy()
        R[self.vertices] = svd_rotations(mixed.swapaxes(1, 2))
        return R

    def carried(self, U: FloatArray, R: FloatArray) -> FloatArray:
        """Return positions (n,3) in which these vertices ride, with rotations of `turned`."""
        points = np.einsum("kc,kcx->kx", self.barycentric, U[self.corners])
        U = U.copy()
        U[self.vertices] = points + np.einsum("kij,kj->ki", R[self.vertices], self.offsets)
        return U


def riding(rest, is_carried):
    """Return the Riding of vertices of cards, a mask (n,), on what is seen and no card.

    Between its vertices, the surface that is solved may be dented where nobody sees it.
    """
    vertices = np.flatnonzero(is_carried)
    firm = rest.shown[~rest.is_card[rest.shown[:, 0]]].astype(np.int64)
    V, count = rest.V, min(_CANDIDATES, len(firm))
    nearest, found = Nearest(V[firm].mean(axis=1)), []
    for block in np.array_split(vertices, -(-len(vertices) // BLOCK)):
        corners = firm[nearest(V[block], k=count).ravel()]
        from_ = np.repeat(V[block], count, axis=0)
        b = closest_points(from_, *(V[corners[:, k]] for k in range(3)))
        d = from_ - np.einsum("kc,kcx->kx", b, V[corners])
        rows = (d * d).sum(axis=1).reshape(-1, count).argmin(axis=1)
        rows += count * np.arange(len(block))
        found.append((corners[rows], b[rows], d[rows]))
    return Riding(vertices, *map(np.concatenate, zip(*found, strict=True)))
