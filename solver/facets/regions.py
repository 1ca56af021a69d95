# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a surface that face one way each, with short borders, and their planes.

Each triangle gets the label of the direction that it is nearest to, made smooth as the sides of
hardening are, and connected triangles of one label are a region. A region that strays from its
plane is parted where it does, and one that is too small goes to the neighbor with the longest
common border.
"""

from dataclasses import dataclass

import numpy as np

from ..aliases import FloatArray, IntArray
from ..details import unit
from ..hardening.sides import CURVED, NEVER, border_shares, smooth_labels, straightened

FEWEST = 6
"""triangles of a region; fewer go to a neighbor if they are no larger than `CLEAR`"""
CLEAR = 5e-3
"""share of the surface of a region that is a side, however few its triangles are"""
SMALLEST = 8e-4
"""the same of one that is none, however many they are"""
_ROUNDS = 4  # of parting
_TURNED = np.cos(np.radians(50.0))  # from its plane: a triangle beyond is of another region
_MERGES = 30


@dataclass(frozen=True, eq=False)
class Regions:
    """Parts of a surface with a plane each.

    Attributes
    ----------
    of_triangle : (m,) int array
    normals : (r,3) array
        Unit normals of the planes.
    offsets : (r,) array
        Their distances from the origin.
    areas : (r,) array
    """

    of_triangle: IntArray
    normals: FloatArray
    offsets: FloatArray
    areas: FloatArray


def nearest_labels(graph, directions, counts=None):
    """Return the direction (m,) that each triangle is for, smooth along the surface.

    Directions that are closer to each other than sides can be tell fine differences apart: the
    labels are the less smooth.

    `graph`: FaceGraph. `directions`: (k,3), unit vectors. `counts`: (m,k) bool, optional, which of
    them each triangle may face.
    """
    cosines = directions @ directions.T
    np.fill_diagonal(cosines, -1.0)
    apart = min(1.0, (1.0 - cosines.max()) / (1.0 - CURVED))
    costs = (1.0 - graph.normals @ directions.T) / max(apart, 1e-9)
    if counts is not None:
        costs[~counts] += NEVER / max(apart, 1e-9)
    return smooth_labels(costs, border_shares(graph, np.ones(len(graph.one), bool)))


def regions_of(V, F, graph, directions, tolerance, counts=None):
    """Part a surface into Regions.

    Parameters
    ----------
    V, F : arrays
        Positions (n,3) and triangles (m,3).
    graph : FaceGraph
        Of these.
    directions : (k,3) array
    tolerance : float
        Vertices farther from the plane of a region belong to another one, if they are many.
    counts : (m,k) bool array, optional
    """
    label = nearest_labels(graph, directions, counts)
    ways = directions
    region = _merged(graph, _connected(graph, label))
    for _ in range(_ROUNDS):
        region, found = _planes(V, F, graph, region, label, ways)
        heights = np.einsum("mcj,mj->mc", V[F], found.normals[region])
        heights -= found.offsets[region][:, None]
        cosines = np.einsum("mj,mj->m", graph.normals, found.normals[region])
        is_off = (np.abs(heights).max(axis=1) > tolerance) | (cosines < _TURNED)
        above = np.where(is_off, np.sign(heights.sum(axis=1)), 0.0)
        parted = _connected(graph, 3 * region + above.astype(np.int64) + 1)
        is_new = np.bincount(parted[is_off], minlength=parted.max() + 1) > 0
        after = _merged(graph, parted)
        if after.max() == region.max() and (after == region).all():
            break
        label = np.where(is_new[parted], len(directions), label)
        region = after
    return _planes(V, F, graph, region, label, ways)[1]


def _connected(graph, label):
    """Return numbers (m,) of the connected parts of one label."""
    return graph.regions(label[graph.one] == label[graph.other])[1].astype(np.int64)


def _merged(graph, region):
    """Return regions (m,) of which the small ones have gone to neighbors."""
    total = graph.areas.sum()
    for _ in range(_MERGES):
        count = region.max() + 1
        area = np.bincount(region, graph.areas, count)
        is_few = np.bincount(region, minlength=count) < FEWEST
        is_small = area < np.where(is_few, CLEAR, SMALLEST) * total
        rank = np.empty(count, np.int64)
        rank[np.lexsort((np.arange(count), -area))] = np.arange(count)  # the largest first
        one, other = region[graph.one], region[graph.other]
        is_border = one != other
        one, other = (
            np.concatenate(p)[np.tile(is_border, 2)] for p in ((one, other), (other, one))
        )
        length = np.tile(graph.length[is_border], 2)
        is_up = is_small[one] & (rank[other] < rank[one])
        one, other, length = one[is_up], other[is_up], length[is_up]
        if not len(one):
            break
        keys, where = np.unique(one * count + other, return_inverse=True)
        length = np.bincount(where.ravel(), length)
        small, into = np.divmod(keys, count)
        order = np.lexsort((-length, small))
        first = order[np.unique(small[order], return_index=True)[1]]
        target = np.arange(count)
        target[small[first]] = into[first]
        while not np.array_equal(target[target], target):
            target = target[target]
        region = _connected(graph, target[region])
    return region


def _planes(V, F, graph, region, label, directions):
    """Return regions numbered by size, and the Regions with the planes that fit them best."""
    count = region.max() + 1
    area = np.bincount(region, graph.areas, count)
    number = np.empty(count, np.int64)
    number[np.argsort(-area, kind="stable")] = np.arange(count)
    region = number[region]
    area = np.bincount(region, graph.areas, count)
    weighted = graph.areas[:, None] * graph.normals
    mean = unit(np.stack([np.bincount(region, x, count) for x in weighted.T], axis=1))
    votes = np.zeros((count, len(directions) + 1))
    np.add.at(votes, (region, label), graph.areas)
    own = votes.argmax(axis=1)
    is_faced = own < len(directions)
    faced = np.where(is_faced[:, None], directions[np.where(is_faced, own, 0)], mean)
    normals = straightened(mean, faced)
    heights = np.einsum("mj,mj->m", V[F].mean(axis=1), normals[region])
    offsets = np.bincount(region, graph.areas * heights, count) / np.where(area > 0.0, area, 1.0)
    return region, Regions(region, normals, offsets, np.asarray(area, dtype=np.float64))
