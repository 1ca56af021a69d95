# SPDX-License-Identifier: GPL-3.0-or-later
"""Halves that stay mirror images of each other.

The global step is followed by a projection onto the positions that are their own image: each
vertex goes to the middle between itself and the image of its partner. Where the mesh is symmetric,
links and triangulation included, that is the global step among symmetric positions; where it is so
but for a few vertices or diagonals, it keeps the halves from growing apart.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial import KDTree

from .rotation_fit import svd_rotations

NO_PARTNER = -1
"""in place of the number of one"""
MATCHING = 1e-3
"""of the largest extent: how far a vertex may be from the image of its partner"""


@dataclass(frozen=True)
class Mirror:
    """A reflection x -> A x + b, and which vertices are each other's images."""

    partner: np.ndarray
    """(n,) int image of each vertex: itself in the plane, -1 where it has none"""
    linear: np.ndarray
    """(3,3) A, with A A = 1"""
    offset: np.ndarray
    """(3,) b, with A b = -b"""

    @property
    def count(self):
        """Number of vertices that have an image."""
        return int(np.count_nonzero(self.partner != NO_PARTNER))

    @cached_property
    def _pairs(self):
        """The first and second vertices of all pairs, and the vertices in the plane."""
        own = np.arange(len(self.partner))
        first = np.flatnonzero(self.partner > own)
        return first, self.partner[first], np.flatnonzero(self.partner == own)

    def image(self, points):
        """Return the reflected points (n,3)."""
        return points @ self.linear.T + self.offset

    def impose(self, positions):
        """Make positions (n,3) symmetric, in place.

        A reflection that only changes signs leaves them mirror images bit for bit.
        """
        first, second, inside = self._pairs
        middle = 0.5 * (positions[first] + self.image(positions[second]))
        positions[first] = middle
        positions[second] = self.image(positions[first])
        positions[inside] = 0.5 * (positions[inside] + self.image(positions[inside]))

    def impose_rotations(self, rotations):
        """Make rotations (n,3,3) of the vertices symmetric, in place."""
        first, second, inside = self._pairs
        inverse = np.linalg.inv(self.linear)
        rotations[second] = self.linear @ rotations[first] @ inverse
        images = self.linear @ rotations[inside] @ inverse
        rotations[inside] = svd_rotations((rotations[inside] + images).swapaxes(1, 2))

    def without(self, is_held):
        """Return the mirror that leaves vertices (n,) and their partners alone."""
        partner = self.partner.copy()
        partner[is_held | is_held[partner]] = NO_PARTNER
        return replace(self, partner=partner)


def partners(V, image, tolerance):
    """Find which vertices are each other's images.

    Parameters
    ----------
    V : (n,3) array
    image : (n,3) array
        Where the reflection takes them.
    tolerance : float
        Largest distance between a vertex and the image of its partner.

    Returns
    -------
    (n,) int array
        As `Mirror.partner`. Each vertex is the nearest to the image of its partner; of several at
        the same place, as along the seams of a UV map, the first belongs to the first.
    """
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
    if len(places) == len(V):  # their order is that of the places
        result = np.full(len(V), NO_PARTNER)
        result[first] = np.where(found == NO_PARTNER, NO_PARTNER, first[found])
        return result
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
    """Return mirrors without those pairs that would undo the symmetry about another plane.

    So that all of them can be imposed, one after the other.
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
