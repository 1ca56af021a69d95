# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a surface that face one way each, with short borders, and their planes.

Each triangle gets the label of the direction that it is nearest to, made smooth as the sides of
hardening are, and connected triangles of one label are a region. A region that strays from its
plane becomes two, and triangles change over to the neighbor whose plane fits them better, so that
borders are where planes meet (Cohen-Steiner, Alliez and Desbrun, "Variational Shape
Approximation", 2004). A region that is too small goes to a neighbor that it fits.
"""

from dataclasses import dataclass

import numpy as np

from ..algebra import sums_by_group
from ..aliases import BoolArray, FloatArray, IntArray
from ..hardening.sides import CURVED, NEVER, border_shares, settled_labels, straightened
from ..surface.details import unit
from .fitting import centroids, exchanged, halves

FEWEST = 6
"""triangles of a region; fewer go to a neighbor if they are no larger than `CLEAR`"""
CLEAR = 5e-3
"""share of the surface of a region that is a side, however few its triangles are"""
SMALLEST = 8e-4
"""the same of one that is none, however many they are, if it fits a neighbor"""
LEAST = 5e-5
"""the same, whether it fits or not"""
WHOLE = 0.6
"""share of a side of a region that counts as all of it"""
_ROUNDS = 6  # of parting
_SMOOTH = 0.1, 0.1, 0.3, 1.0  # of the borders, while planes are fitted again and again
_TURNED = np.cos(np.radians(50.0))  # from its plane: a triangle beyond is of another region
_MERGES = 30


@dataclass(frozen=True, eq=False)
class Regions:
    """Parts of a surface with a plane each."""

    of_triangle: IntArray
    """(m,) int"""
    normals: FloatArray
    """(r,3) unit normals of the planes"""
    offsets: FloatArray
    """(r,) their distances from the origin"""
    areas: FloatArray
    """(r,)"""
    is_faced: BoolArray
    """(r,) bool, which of them face a direction exactly"""


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
    shares = border_shares(graph, np.ones(len(graph.one), bool))
    return settled_labels(np.float32(costs), shares)


def regions_of(V, F, graph, directions, tolerance, counts=None):
    """Part a surface into Regions.

    `V`, `F`: positions (n,3) and triangles (m,3). `graph`: FaceGraph of these. `directions`: (k,3).
    `tolerance`: float, vertices farther from the plane of a region belong to another one, if they
    are many. `counts`: as of `nearest_labels`.
    """
    X, label = V[F], nearest_labels(graph, directions, counts)
    side = _connected(graph, label)
    ways = directions[label[np.unique(side, return_index=True)[1]]]

    C = centroids(X)

    def planes(region):
        return _planes(C, graph, region, side, ways)

    region = _merged(graph, X, side, planes, tolerance)
    for _ in range(_ROUNDS):
        found = planes(region)
        region = found.of_triangle
        is_off = _is_off(X, graph.normals, found, tolerance)
        area = np.bincount(region, graph.areas * is_off, len(found.areas))
        strays = np.flatnonzero(area > SMALLEST * graph.areas.sum())
        if not len(strays):
            break
        for number in strays:
            rows = np.flatnonzero(region == number)
            is_second = halves(X[rows], graph.normals[rows], graph.areas[rows], tolerance)
            region[rows[is_second]] = region.max() + 1
        region = _connected(graph, region)
        for smooth in _SMOOTH:
            region = exchanged(graph, X, planes(region), tolerance, smooth)
        region = _merged(graph, X, _connected(graph, region), planes, tolerance)
    return planes(region)


def _is_off(X, N, regions, tolerance):
    """Return which triangles (m,3,3) with normals (m,3) do not fit their regions."""
    normals = regions.normals[regions.of_triangle]
    heights = np.einsum("mcj,mj->mc", X, normals) - regions.offsets[regions.of_triangle][:, None]
    return (np.abs(heights).max(axis=1) > tolerance) | ((N * normals).sum(axis=1) < _TURNED)


def _connected(graph, label):
    return graph.regions(label[graph.one] == label[graph.other])[1].astype(np.int64)


def _merged(graph, X, region, planes, tolerance):
    """Return regions (m,) of which the small ones have gone to neighbors that they fit."""
    total = graph.areas.sum()
    for _ in range(_MERGES):
        found = planes(region)  # the largest come first
        region, area = found.of_triangle, found.areas
        count = len(area)
        is_few = np.bincount(region, minlength=count) < FEWEST
        is_small = area < np.where(is_few, CLEAR, SMALLEST) * total
        one, other = region[graph.one], region[graph.other]
        ends = np.maximum(one, other), np.minimum(one, other)
        rows = np.flatnonzero(is_small[ends[0]] & (one != other))
        keys, where = np.unique(ends[0][rows] * count + ends[1][rows], return_inverse=True)
        length = np.bincount(where.ravel(), graph.length[rows], len(keys))
        small, into = np.divmod(keys, count)
        fits = _fits(graph, X, found, small, into, tolerance)
        goes = fits | (area[small] < LEAST * total)
        if not goes.any():
            break
        small, into, length, fits = (each[goes] for each in (small, into, length, fits))
        order = np.lexsort((-length, ~fits, small))
        first = order[np.unique(small[order], return_index=True)[1]]
        target = np.arange(count)
        target[small[first]] = into[first]
        while not np.array_equal(target[target], target):
            target = target[target]
        region = _connected(graph, target[region])
    return region


def _fits(graph, X, regions, small, into, tolerance):
    """Return which regions (k,), in ascending order, would be in the planes of others (k,)."""
    order = np.argsort(regions.of_triangle, kind="stable")
    starts, ends = (
        np.searchsorted(regions.of_triangle[order], small, side) for side in ("left", "right")
    )
    found = np.zeros(len(small), bool)
    for k, plane in enumerate(into):
        rows = order[starts[k] : ends[k]]
        heights = X[rows] @ regions.normals[plane] - regions.offsets[plane]
        faces = graph.areas[rows] @ (graph.normals[rows] @ regions.normals[plane])
        is_near = np.abs(heights).max() <= tolerance
        found[k] = is_near and faces > _TURNED * graph.areas[rows].sum()
    return found


def _planes(C, graph, region, side, ways):
    """Return Regions numbered by size, with the planes that fit them best.

    A region that is as good as a whole side faces exactly the way (3,) of that, or nearly.
    """
    count = region.max() + 1
    number = np.empty(count, np.int64)
    number[np.argsort(-np.bincount(region, graph.areas, count), kind="stable")] = np.arange(count)
    region = number[region]
    area = np.bincount(region, graph.areas, count)
    keys, where = np.unique(region * len(ways) + side, return_inverse=True)
    common = np.bincount(where.ravel(), graph.areas, len(keys))
    is_whole = common > WHOLE * np.bincount(side, graph.areas, len(ways))[keys % len(ways)]
    keys = keys[is_whole][np.argsort(common[is_whole], kind="stable")]  # the largest has its way
    weighted = graph.areas[:, None] * graph.normals
    mean = unit(sums_by_group(weighted, region, count))
    faced = mean.copy()
    faced[keys // len(ways)] = ways[keys % len(ways)]
    normals = straightened(mean, faced)
    is_faced = np.zeros(count, bool)
    is_faced[keys // len(ways)] = True
    is_faced &= (normals == faced).all(axis=1)
    heights = np.einsum("mj,mj->m", C, normals[region])
    offsets = np.bincount(region, graph.areas * heights, count) / np.where(area > 0.0, area, 1.0)
    return Regions(region, normals, offsets, np.asarray(area, dtype=np.float64), is_faced)
