# SPDX-License-Identifier: GPL-3.0-or-later
"""How well triangles fit planes, and which plane of their neighbors they fit best."""

import numpy as np

from ..surface.details import unit

FAR = 0.5
"""what it costs a triangle to be off a plane by the tolerance, in units of 1 - cosine"""
_ROUNDS = 6  # of two planes that part a region
_SWEEPS = 40  # of triangles that change over
_LEAST_GAIN = 1e-4  # of such a change
_LEAST_AREA = 1e-30


def centroids(X):
    """Return the centroids (m,3) of triangles (m,3,3), sooner than NumPy's mean of three."""
    return (X[:, 0] + X[:, 1] + X[:, 2]) / 3.0


def fit(C, N, areas):
    """Return the normal (3,) and the offset of the plane of triangles on average.

    `C`, `N`: (m,3), their centroids and normals. `areas`: (m,), their weights.
    """
    normal = unit((areas @ N)[None])[0]
    return normal, areas @ (C @ normal) / max(areas.sum(), _LEAST_AREA)


def misfit(X, N, normals, offsets, tolerance):
    """Return what it costs (m,) triangles (m,3,3) with normals N (m,3) to be in planes.

    `normals`, `offsets`: (m,3) and (m,), or of one plane for all.
    """
    x, y, z = np.atleast_2d(normals).T
    heights = X[..., 0] * x[:, None] + X[..., 1] * y[:, None] + X[..., 2] * z[:, None]
    a, b, c = (((heights - np.atleast_1d(offsets)[:, None]) / tolerance) ** 2).T
    return FAR * ((a + b + c) / 3.0) + 1.0 - (N[:, 0] * x + N[:, 1] * y + N[:, 2] * z)


def halves(X, N, areas, tolerance):
    """Return which triangles (m,) are in the second half of a region that is to be two.

    Two planes take those that they fit better each, and are fitted to them. They begin on both
    sides of a bend, or above and below a step, whichever ends better.

    `X`, `N`, `tolerance`: as of `misfit`. `areas`: as of `fit`.
    """
    weights = areas / areas.sum()
    around = N - weights @ N
    bend = np.linalg.eigh((around * weights[:, None]).T @ around)[1][:, -1]
    C = centroids(X)
    away = C - weights @ C
    found = [
        _two_planes(X, C, N, areas, tolerance, away @ way > 0.0)
        for way in (bend, fit(C, N, areas)[0])
    ]
    return min(found, key=lambda pair: weights @ pair[0])[1]


def _two_planes(X, C, N, areas, tolerance, is_second):
    """Return what triangles cost (m,) by two planes, and which (m,) are in the second."""
    for _ in range(_ROUNDS):
        planes = [fit(C, N, areas * mine) for mine in (~is_second, is_second)]
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
    is_open = np.ones(m, bool)  # whose gain may be another one than in the sweep before
    for _ in range(_SWEEPS):
        rows = np.flatnonzero(is_open[one])
        rows = rows[region[one[rows]] != region[other[rows]]]
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
        is_open = most > _LEAST_GAIN
        is_open[f[is_best]] = True
        is_open[other[is_open[one]]] = True
    return region
