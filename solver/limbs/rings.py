# SPDX-License-Identifier: GPL-3.0-or-later
"""Rings, such as wheels and rolled rims: they lie as their axis does, all around.

As pieces of limbs, each of which lies its own way, a wheel would become a polygon of many sides.
"""

import numpy as np

from ..mesh.components import components

SMOOTH = np.cos(np.radians(50.0))
"""between the directions of pieces that go on in each other: spokes do not"""
FLAT, ROUND = 0.2, 0.2
"""of the radius: how far nodes may be from the plane and from the circle, at most: frames with four
corners are no rings"""
GAP = 1.1
"""radians: between neighbors around it, at most: a bracelet may be open"""
FEWEST = 8
"""nodes"""


def with_rings(piece, directions, places, graph):
    """Return pieces (m,) and directions (s,3) in which those of a ring are one, along its axis.

    `piece`: (m,) int, -1 for none. `places`: (m,3), of the nodes. `graph`: (m,m), of neighbors.
    """
    one, other = (piece[ends] for ends in graph.nonzero())
    is_pair = (one >= 0) & (other > one)
    pairs = np.unique(np.stack([one, other], axis=1)[is_pair], axis=0)
    cosines = np.abs((directions[pairs[:, 0]] * directions[pairs[:, 1]]).sum(axis=1))
    of_rings, found = piece.copy(), list(directions)
    for least in (0.0, SMOOTH):  # where nodes are few, their directions are noise
        count, group = components(pairs[cosines >= least], len(directions))
        of_node = np.where(piece >= 0, group[piece], -1)
        for number in np.flatnonzero(np.bincount(group, minlength=count) > 2):
            rows = np.flatnonzero(of_node == number)
            axis = _axis(places[rows])
            if axis is not None:
                of_rings[rows] = len(found)
                found.append(axis)
    return of_rings, np.array(found)


def _axis(places):
    """Return the axis (3,) of a ring with nodes at such places (k,3), None if it is none."""
    if len(places) < FEWEST:
        return None
    away = places - places.mean(axis=0)
    axes = np.linalg.eigh(away.T @ away)[1]
    height, across = away @ axes[:, 0], away @ axes[:, 1:]
    # the circle |x|^2 = 2 c.x + d of least squares
    A = np.column_stack([2.0 * across, np.ones(len(away))])
    middle = np.linalg.lstsq(A, (across**2).sum(axis=1), rcond=None)[0][:2]
    x, y = (across - middle).T
    distance, around = np.hypot(x, y), np.sort(np.arctan2(y, x))
    radius = distance.mean()
    gaps = np.diff(around, append=around[0] + 2.0 * np.pi)
    is_ring = np.abs(height).max() < FLAT * radius and gaps.max() < GAP
    is_ring &= np.abs(distance - radius).max() < ROUND * radius
    return axes[:, 0] if is_ring else None
