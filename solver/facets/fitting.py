# SPDX-License-Identifier: GPL-3.0-or-later
"""How well triangles fit planes, and which plane of their neighbors they fit best."""

import numpy as np

from ..details import unit

FAR = 0.5
"""what it costs a triangle to be off a plane by the tolerance, in units of 1 - cosine"""
_ROUNDS = 6  # of two planes that part a region
_SWEEPS = 40  # of triangles that change over
_LEAST_GAIN = 1e-4  # of such a change
_LEAST_AREA = 1e-30


def fit(X, N, areas):
    """Return the normal (3,) and the offset of the plane of triangles (m,3,3) on average.

    `N`: (m,3), their normals. `areas`: (m,), their weights.
    """
    normal = unit((areas @ N)[None])[0]
    return normal, areas @ (X.mean(axis=1) @ normal) / max(areas.sum(), _LEAST_AREA)


def misfit(X, N, normals, offsets, tolerance):
    """Return what it costs (m,) triangles (m,3,3) with normals N (m,3) to be in planes.

    `normals`, `offsets`: (m,3) and (m,), or of one plane for all.
    """
    heights = (X * np.atleast_2d(normals)[:, None]).sum(axis=2) - np.atleast_1d(offsets)[:, None]
    return FAR * ((heights / tolerance) ** 2).mean(axis=1) + 1.0 - (N * normals).sum(axis=1)


def halves(X, N, areas, tolerance):
    """Return which triangles (m,) are in the second half of a region that is to be two.

    Two planes take those that they fit better each, and are fitted to them. They begin on both
    sides of a bend, or above and below a step, whichever ends better.

    `X`, `N`, `areas`: as of `fit`. `tolerance`: as of `misfit`.
    """
    weights = areas / areas.sum()
    around = N - weights @ N
    bend = np.linalg.eigh((around * weights[:, None]).T @ around)[1][:, -1]
    C = X.mean(axis=1) - weights @ X.mean(axis=1)
    found = [
        _two_planes(X, N, areas, tolerance, C @ way > 0.0) for way in (bend, fit(X, N, areas)[0])
    ]
    return min(found, key=lambda pair: weights @ pair[0])[1]


def _two_planes(X, N, areas, tolerance, is_second):
    """Return what triangles cost (m,) by two planes, and which (m,) are in the second."""
    for _ in range(_ROUNDS):
        planes = [fit(X, N, areas * mine) for mine in (~is_second, is_second)]
        costs = [misfit(X, N, *plane, tolerance) for plane in planes]
        is_closer = costs[1] < costs[0]
        if np.array_equal(is_closer, is_second) or is_closer.all() or not is_closer.any():
            break
        is_second = is_closer
    return np.minimum(*costs), is_second


def exchanged(graph, X, regions, tolerance, smooth):
    """Return regions (m,) of which triangles have gone over to neighbors that they fit better.

    `graph`: FaceGraph. `X`: (m,3,3), corners. `regions`: Regions. `smooth`: float, how much a
    triangle follows its neighbors, next to what it costs to be in a plane.
    """
    m, N, region = len(X), graph.normals, regions.of_triangle.copy()
    one = np.concatenate([graph.one, graph.other])
    other = np.concatenate([graph.other, graph.one])
    share = np.tile(graph.length, 2)
    share /= np.bincount(one, share, m)[one]
    normals, offsets = regions.normals, regions.offsets
    costs = misfit(X, N, normals[region], offsets[region], tolerance)
    for _ in range(_SWEEPS):
        rows = np.flatnonzero(region[one] != region[other])
        keys = one[rows] * len(offsets) + region[other[rows]]
        keys, where = np.unique(keys, return_inverse=True)
        f, r = np.divmod(keys, len(offsets))
        new = misfit(X[f], N[f], normals[r], offsets[r], tolerance)
        follows = np.bincount(where.ravel(), share[rows], len(keys))
        stays = 1.0 - np.bincount(one[rows], share[rows], m)[f]
        gain = costs[f] - new + smooth * (follows - stays)
        most = np.full(m, _LEAST_GAIN)
        np.maximum.at(most, f, gain)
        near = np.zeros(m)  # neighbors never change at once: they would change places again
        np.maximum.at(near, one[rows], most[other[rows]])
        is_best = (gain >= most[f]) & (most[f] > near[f])
        if not is_best.any():
            break
        region[f[is_best]], costs[f[is_best]] = r[is_best], new[is_best]
    return region
