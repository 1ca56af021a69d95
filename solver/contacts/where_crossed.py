# SPDX-License-Identifier: GPL-3.0-or-later
"""Where parts may come to cross: beside where they did at rest."""

import numpy as np
from scipy.spatial import KDTree

BESIDE = 0.03
"""of the size: how far from where two parts cross at rest they may come to cross,..."""
LONG = 0.1
"""...if one has triangles with longer edges there"""


def are_where_parts_crossed(rest, pairs):
    """Return which pairs (k,2) are of two parts, one long, and near where they cross at rest.

    `pairs`: of the triangles that are shown of a RestMesh.

    A stick in a hand goes into it elsewhere as both become square. It would stay round all along
    its long triangles; small ones may stay soft, or an eye would come through its lid.
    """
    V, F = rest.V, rest.shown
    part = rest.topology.part[F[pairs, 0]]
    found = np.flatnonzero(part[:, 0] != part[:, 1])
    corners = V[F[pairs[found]]]
    is_long = np.linalg.norm(corners - np.roll(corners, 1, axis=2), axis=3).max(axis=2) > LONG
    found = found[is_long.any(axis=1)]
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
