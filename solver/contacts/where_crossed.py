# SPDX-License-Identifier: GPL-3.0-or-later
"""Where parts may come to cross: where they touch, and beside where they crossed at rest."""

import numpy as np
from scipy.spatial import KDTree

from ..proxy.closest_point import closest_points
from .crossings import DEPTH

BESIDE = 0.03
"""of the size: how far from where two parts cross at rest they may come to cross,..."""
LONG = 0.1
"""...if one has triangles with longer edges there, or if neither is worn"""
TOUCHING, SHALLOW = 10.0 * DEPTH, 0.003
"""in the unit box: what is no farther apart at rest may press into each other by so much"""


def are_where_parts_crossed(rest, pairs):
    """Return which pairs (k,2) are of two parts, and near where they cross at rest.

    `pairs`: of the triangles that are shown of a RestMesh.

    A fin or a stick goes into its body elsewhere as both become square: it would stay round there,
    or all along its long triangles. But small ones of skin would come through a shirt.
    """
    V, F = rest.V, rest.shown
    part = rest.topology.part[F[pairs, 0]]
    found = np.flatnonzero(part[:, 0] != part[:, 1])
    corners = V[F[pairs[found]]]
    is_long = np.linalg.norm(corners - np.roll(corners, 1, axis=2), axis=3).max(axis=2) > LONG
    is_worn = rest.is_worn[part[found]].any(axis=1)
    found = found[is_long.any(axis=1) | ~is_worn]
    are_all = np.zeros(len(pairs), dtype=bool)
    if not len(found):
        return are_all
    corners = np.unique(F[pairs[found]])
    is_near = KDTree(V[corners]).query(V, distance_upper_bound=BESIDE)[0] < BESIDE
    asked = np.flatnonzero(is_near[F].any(axis=1))
    crossed = np.unique(F[asked[rest.crosses_at_rest(asked)]])
    if not len(crossed):
        return are_all
    is_beside = np.zeros(len(V), dtype=bool)
    is_beside[corners] = KDTree(V[crossed]).query(V[corners])[0] < BESIDE
    are_all[found] = np.any(is_beside[F], axis=1)[pairs[found]].all(axis=1)
    return are_all


def are_where_parts_touched(rest, U, pairs):
    """Return which pairs (k,2) are of two parts that touched there, and hardly press in.

    `pairs`: of the triangles that are shown of a RestMesh, which cross at positions U (n,3). A
    candle on a cake would dent it, if not even this was allowed.
    """
    F, part = rest.shown[pairs], rest.topology.part
    found = np.flatnonzero(part[F[:, 0, 0]] != part[F[:, 1, 0]])
    both = (F[found], F[found, ::-1])
    depth = [_depths(U[triangles]) for triangles in both]
    found = found[np.minimum(*depth) < SHALLOW]
    distance = [_distances(rest.V[triangles]) for triangles in (F[found], F[found, ::-1])]
    are_all = np.zeros(len(pairs), dtype=bool)
    touching = np.unique(pairs[found[np.minimum(*distance) < TOUCHING]])
    are_all[found] = np.isin(pairs[found], touching).any(axis=1)  # and what is beside it
    return are_all


def _depths(corners):
    """Return how far (k,) the first of two triangles each, (k,2,3,3), reaches through the other."""
    first, other = corners.swapaxes(0, 1)
    normal = np.cross(other[:, 1] - other[:, 0], other[:, 2] - other[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    height = np.einsum("kcx,kx->kc", first - other[:, :1], normal)
    return np.minimum(height.max(axis=1), -height.min(axis=1))


def _distances(corners):
    """Return the least distance (k,) of corners of the first of two triangles each to the other."""
    first, other = corners.swapaxes(0, 1)
    points, triangles = first.reshape(-1, 3), np.repeat(other, 3, axis=0)
    weights = closest_points(points, *triangles.swapaxes(0, 1))
    away = np.einsum("kc,kcx->kx", weights, triangles) - points
    return np.linalg.norm(away, axis=1).reshape(-1, 3).min(axis=1)
