# SPDX-License-Identifier: GPL-3.0-or-later
"""The few directions that a surface faces most."""

import numpy as np

from ..algebra import sums_by_group
from ..errors import CubicCraftError
from .polytope import encloses_origin

NEAR = np.cos(np.radians(12.0))
"""of the angle within which normals have one direction"""
LEAST_SHARE = 1e-3
"""of all area; less makes no direction of its own"""
_ROUNDS = 8
_BINS = 50  # per unit; normals in one cell count as one


def binned(normals, areas, bins):
    """Return mean directions (k,3) of the cells of the sphere and their areas (k,).

    `normals`: (n,3), unit normals; zero ones are left out. `areas`: (n,), those with area zero are
    left out. `bins`: int, cells per unit length.
    """
    is_there = (areas > 0.0) & (np.abs(normals).max(axis=1) > 0.0)
    n, a = normals[is_there], areas[is_there]
    _, cell = np.unique(np.round(bins * n).astype(np.int64), axis=0, return_inverse=True)
    cell = cell.ravel()
    sums = sums_by_group(a[:, None] * n, cell)
    return sums / np.linalg.norm(sums, axis=1, keepdims=True), np.bincount(cell, a)


def directions_of(normals, areas, most):
    """Return directions that the normals of a surface cluster about, such that they enclose 0.

    The normal with most area near it becomes a direction, and so on with the rest; then each moves
    to the mean of the normals that it is nearest to. Where they do not point to all sides, those
    opposite are added, and if they lie in one plane, its two normals.

    `normals`: (n,3), unit normals. `areas`: (n,), their weights. `most`: int, at least 6. Returns
    (k,3) of unit vectors. Raises CubicCraftError: there is no normal with an area.
    """
    d, a = binned(np.asarray(normals, np.float64), np.asarray(areas, np.float64), _BINS)
    if not len(d):
        raise CubicCraftError("it has no faces with an area")
    all_sides = enclosing(_clusters(d, a, most))
    if len(all_sides) <= most:
        return all_sides
    return enclosing(_clusters(d, a, most // 2 - 1))  # room for those opposite, and for an axis


def _clusters(d, a, most):
    """Return unit vectors (k,3), at most so many, that unit vectors d with weights a lie about."""
    found = []
    left = a.copy()
    near = d @ d.T > NEAR if len(d) <= 3000 else None
    while len(found) < most and left.sum() > LEAST_SHARE * a.sum():
        around = (near @ left) if near is not None else left
        best = int(np.argmax(np.where(left > 0.0, around, -1.0)))
        found.append(d[best])
        left[d @ d[best] > NEAR] = 0.0
    found = np.array(found)
    for _ in range(_ROUNDS):
        nearest = (d @ found.T).argmax(axis=1)
        sums = np.zeros_like(found)
        np.add.at(sums, nearest, a[:, None] * d)
        sizes = np.linalg.norm(sums, axis=1, keepdims=True)
        found = np.where(sizes > 0.0, sums / np.where(sizes > 0.0, sizes, 1.0), found)
    return found


def enclosing(d):
    """Return directions (k,3) that point to all sides: these, and if needed others.

    Those opposite are added, and where all lie in one plane or on one line, the axes across it.
    """
    if encloses_origin(d):
        return d
    both = np.concatenate([d, -d])
    if encloses_origin(both):
        return both
    _, _, axes = np.linalg.svd(d)
    rank = int(np.linalg.matrix_rank(d, tol=0.05))
    rest = axes[rank:]
    return np.concatenate([both, rest, -rest])
