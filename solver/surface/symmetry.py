# SPDX-License-Identifier: GPL-3.0-or-later
"""Halves that stay mirror images of each other.

The global step is followed by a projection onto the positions that are their own image: each
vertex moves halfway toward the image of its partner. If the mesh is symmetric, including its links
and triangulation, this is the global step among symmetric positions. If it is symmetric except for
a few vertices or diagonals, the projection keeps the halves from diverging.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..aliases import BoolArray, FloatArray, IntArray, RealArray
from ..rotation_fit import svd_rotations
from ..values import Value

NO_PARTNER = -1
"""in place of the index of a partner"""
LEAST_MATCHING = 0.8
"""share of the vertices that must have partners; those of fewer would tear the others apart"""
MATCHING = 1e-3
"""largest distance of a vertex from the image of its partner, relative to the largest extent"""


@dataclass(frozen=True, eq=False, repr=False)
class Mirror(Value):
    """A reflection x -> A x + b, and the vertices that are images of each other.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import Mirror
    >>> mirror = Mirror(np.array([1, 0]), np.diag([-1.0, 1, 1]), np.zeros(3))
    >>> positions = np.array([[1.0, 0, 0], [-1, 1, 0]])
    >>> mirror.impose(positions)
    >>> positions
    array([[ 1. ,  0.5,  0. ],
           [-1. ,  0.5,  0. ]])
    """

    partner: IntArray
    """(n,) int image of each vertex: itself in the plane, -1 if it has none"""
    linear: FloatArray
    """(3,3) A, with A A = 1"""
    offset: FloatArray
    """(3,) b, with A b = -b"""

    @property
    def count(self) -> int:
        """Number of vertices that have an image."""
        return int(np.count_nonzero(self.partner != NO_PARTNER))

    @cached_property
    def _pairs(self):
        """The first and second vertices of all pairs, and the vertices in the plane."""
        own = np.arange(len(self.partner))
        first = np.flatnonzero(self.partner > own)
        return first, self.partner[first], np.flatnonzero(self.partner == own)

    def image(self, points: FloatArray) -> FloatArray:
        """Return the reflected points (n,3)."""
        return points @ self.linear.T + self.offset

    def impose(self, positions: FloatArray) -> None:
        """Make positions (n,3) symmetric, in place.

        A reflection that only changes signs leaves them mirror images bit for bit.
        """
        first, second, inside = self._pairs
        middle = 0.5 * (positions[first] + self.image(positions[second]))
        positions[first] = middle
        positions[second] = self.image(positions[first])
        positions[inside] = 0.5 * (positions[inside] + self.image(positions[inside]))

    def impose_rotations(self, rotations: FloatArray) -> None:
        """Make rotations (n,3,3) of the vertices symmetric, in place."""
        first, second, inside = self._pairs
        inverse = np.linalg.inv(self.linear)
        rotations[second] = self.linear @ rotations[first] @ inverse
        images = self.linear @ rotations[inside] @ inverse
        rotations[inside] = svd_rotations((rotations[inside] + images).swapaxes(1, 2))

    def suits(self, points: RealArray, reach: float) -> bool:
        """Return whether partners are images of each other at points (n,3), up to a distance."""
        rows = np.flatnonzero(self.partner != NO_PARTNER)
        images = self.image(points[self.partner[rows]].astype(np.float64))
        return bool(np.abs(images - points[rows]).max(initial=0.0) <= reach)

    def without(self, is_held: BoolArray) -> Mirror:
        """Return the mirror without the vertices of a mask (n,) and without their partners."""
        partner = self.partner.copy()
        partner[is_held | is_held[partner]] = NO_PARTNER
        return replace(self, partner=partner)


def partners(V: FloatArray, image: FloatArray, tolerance: float) -> IntArray:
    """Return the vertices (n,) that are images of each other, as `Mirror.partner`.

    `V`, `image`: (n,3), the vertices and these reflected. `tolerance`: largest distance between a
    vertex and the image of its partner. Each is the nearest to that image; of several at the same
    place, as along the seams of a UV map, the first is paired with the first.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import partners
    >>> V = np.array([[1.0, 0, 0], [-1, 0, 0], [0, 2, 0], [5, 5, 5]])
    >>> partners(V, V * [-1, 1, 1], tolerance=1e-3)
    array([ 1,  0,  2, -1])
    """
    from scipy.spatial import KDTree  # here, because few need it

    places, first, place, count = np.unique(
        V, axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    place = place.reshape(-1)
    tree = KDTree(places)
    distance, nearest = tree.query(image[first], distance_upper_bound=tolerance)
    found = np.where(distance <= tolerance, nearest, len(places))
    found = np.append(found, len(places))  # as the image of no vertex
    is_mutual = found[found[:-1]] == np.arange(len(places))
    found = np.where(is_mutual, found[:-1], NO_PARTNER)
    order = np.argsort(place, kind="stable")
    begin = np.append(0, np.cumsum(count))
    rank = np.empty(len(V), dtype=np.intp)
    rank[order] = np.arange(len(V)) - begin[place[order]]
    other = found[place]
    has_one = (other != NO_PARTNER) & (rank < count[other])
    result = np.full(len(V), NO_PARTNER)
    result[has_one] = order[begin[other[has_one]] + rank[has_one]]
    return result


def commuting(mirrors: Sequence[Mirror]) -> tuple[Mirror, ...]:
    """Return mirrors without the pairs that would break the symmetry about another plane.

    All of them can then be imposed one after the other, as in a `Setup`.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import Mirror, commuting
    >>> x = Mirror(np.array([1, 0, -1]), np.diag([-1.0, 1, 1]), np.zeros(3))
    >>> y = Mirror(np.array([2, -1, 0]), np.diag([1.0, -1, 1]), np.zeros(3))
    >>> [mirror.count for mirror in commuting([x, y])]  # vertex 1 has no partner about y
    [0, 2]
    """
    found = [mirror.partner.copy() for mirror in mirrors]
    is_changed = len(found) > 1
    while is_changed:
        is_changed = False
        for one in found:
            for other in found:
                if one is other:
                    continue
                there = np.where(one == NO_PARTNER, NO_PARTNER, np.append(other, NO_PARTNER)[one])
                back = np.where(other == NO_PARTNER, NO_PARTNER, np.append(one, NO_PARTNER)[other])
                is_wrong = (one != NO_PARTNER) & (there != back)
                if is_wrong.any():
                    is_changed = True
                    one[one[is_wrong]] = NO_PARTNER
                    one[is_wrong] = NO_PARTNER
    pairs = zip(mirrors, found, strict=True)
    return tuple(replace(mirror, partner=partner) for mirror, partner in pairs)
