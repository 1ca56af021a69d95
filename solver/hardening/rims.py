# SPDX-License-Identifier: GPL-3.0-or-later
"""Narrow sides: the rim of a brim, a lid or a wheel, which gives the whole its outline.

It has too little area to become straight against what holds the soft shape, and encloses next to no
volume that would have to be held.
"""

import numpy as np

from ..mesh.edges import stable_order

NARROW = 0.1, 0.3
"""area over the squared diagonal: a side with less than the first is a rim, one with more than the
second is none"""
FREE = 0.02
"""share of the hold that a rim keeps"""
LARGER = 3.0
"""times the area of a rim: the flats on both sides of it"""
FEWEST = 4
"""triangles of a side; fewer are frayed"""


def rims_and_flats(graph, V, F, side, facing):
    """Return how far vertices (n,) belong to rims, and how far to these or to flats between them.

    `graph`: FaceGraph. `V`: (n,3), positions of the soft shape. `F`: (m,3) int. `side`: (m,) int.
    `facing`: (m,3), as `sides_of` returns them.
    """
    count, region = graph.regions_of_sides(side)
    width = np.bincount(region, graph.areas, count) / diagonals(V, F, region, count) ** 2
    share = np.clip((width - NARROW[0]) / (NARROW[1] - NARROW[0]), 0.0, 1.0)
    rim = np.where(np.bincount(region, minlength=count) < FEWEST, 0.0, 1.0 - share)
    rim, flat = _between_flats(graph, region, rim, facing)
    at_rims, at_flats = np.zeros((2, len(V)))
    np.maximum.at(at_rims, F.ravel(), np.repeat(rim[region], 3))
    np.maximum.at(at_flats, F.ravel(), np.repeat(flat[region], 3))
    return at_rims, np.maximum(at_rims, at_flats)


def diagonals(V, F, region, count):
    """Return the diagonals (r,) of the boxes around regions of triangles (m,3), none of them 0."""
    order = stable_order(region, count)
    starts = np.append(0, np.cumsum(np.bincount(region, minlength=count))[:-1])
    corners, sides = F[order].T, []
    for x in V.T:
        low, high = (extreme.reduce(x.take(corners)) for extreme in (np.minimum, np.maximum))
        sides.append(np.maximum.reduceat(high, starts) - np.minimum.reduceat(low, starts))
    return np.maximum(np.linalg.norm(sides, axis=0), 1e-150)


def _between_flats(graph, region, rim, facing):
    """Return how far regions (k,) are rims between parallel flats, and how far they are these.

    Both may face the same way, as the treads of a step.
    """
    count = len(rim)
    area = np.bincount(region, graph.areas, count)
    of_region = np.zeros((count, 3))
    of_region[region] = facing
    one, other = region[graph.one], region[graph.other]
    a, b = np.concatenate([one, other]), np.concatenate([other, one])
    is_pair = (a != b) & (LARGER * area[a] < area[b]) & (rim[a] > 0.0)
    a, b = a[is_pair], b[is_pair]
    a, b = np.unique(np.stack([a, b]), axis=1)  # one of each pair
    parallel = np.zeros((count, 3), np.intp)
    np.add.at(parallel, a, np.abs(of_region[b]) > 0.9)
    rim = np.where((parallel > 1).any(axis=1), rim, 0.0)
    flat = np.zeros(count)
    np.maximum.at(flat, b, rim[a])
    return rim, flat
