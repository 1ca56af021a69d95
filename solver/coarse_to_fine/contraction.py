# SPDX-License-Identifier: GPL-3.0-or-later
"""A coarser mesh of the same shape: vertices contracted with their neighbors."""

import numpy as np

from ..algebra import sums_by_group
from ..global_step.multigrid import aggregates
from ..mesh.edges import distinct
from ..optional_packages import optional_package

MOST_LEFT = 0.7
"""of the vertices; more, and levels without end would follow each other"""
FEWEST = 20
"""triangles of a part; one that would be left with fewer stays as it is"""


def contract(V, F, neighbors, part):
    """Contract the vertices of a mesh in groups, each of a vertex and what is around it.

    They are the aggregates of algebraic multigrid, about eight vertices each. A triangle stays
    where three of them meet, so a closed surface stays closed. That takes a tenth of the time of
    collapsing one edge after the other by its error (Garland and Heckbert, 1997), and the triangles
    are rounder; the details that it loses would be new to the cube on the finer mesh anyway.

    `V`: (n,3). `F`: (m,3) int, triangles that use all vertices. `neighbors`: (n,n) csr_matrix, with
    entries between vertices that share a triangle. `part`: (n,) int, connected part of each vertex.
    Returns `V`: (k,3); `F`: (l,3) int, triangles that use all of them; `cluster`: (n,) int, the
    vertex of the result that each vertex has been contracted into; None where the package pyamg is
    missing, nothing is left of the mesh, or almost all of it is.
    """
    if optional_package("pyamg") is None:
        return None
    group = aggregates(neighbors)
    group = _with_small_parts_apart(group, F, part)
    triangles = distinct(group[F])
    is_used = np.zeros(group.max() + 1, dtype=bool)
    is_used[triangles] = True
    count = np.count_nonzero(is_used)
    if not 0 < count <= MOST_LEFT * len(V):
        return None
    number = np.cumsum(is_used) - 1
    sizes = np.bincount(group)
    means = sums_by_group(V, group) / sizes[:, None]
    cluster = number[_nearest_used(group[F], is_used)[group]]
    return means[is_used], number[triangles], cluster


def _with_small_parts_apart(group, F, part):
    """Return the groups (n,) anew, each vertex of its own where too few triangles would be left."""
    corners = group[F]
    a, b, c = corners.T
    is_left = (a != b) & (b != c) & (c != a)
    few = np.bincount(part[F[is_left, 0]], minlength=part.max() + 1) < FEWEST
    if not few.any():
        return group
    group = np.where(few[part], group.max() + 1 + np.arange(len(group)), group)
    is_present = np.zeros(group.max() + 1, dtype=bool)
    is_present[group] = True
    return (np.cumsum(is_present) - 1)[group]


def _nearest_used(corners, is_used):
    """Return for each group (g,) itself or, if it has lost all its triangles, one beside it.

    Such groups follow each other along a spike. Of a part that has collapsed, none is used: how it
    starts does not matter.

    corners : (m,3) int array, groups of the corners of the triangles before
    """
    nearest = np.where(is_used, np.arange(len(is_used)), np.flatnonzero(is_used)[0])
    is_reached = is_used.copy()
    around = corners[~is_used[corners].all(axis=1)]  # few
    start, end = around[:, [0, 1, 2, 1, 2, 0]].ravel(), around[:, [1, 2, 0, 0, 1, 2]].ravel()
    while True:
        is_next = ~is_reached[start] & is_reached[end]
        if not is_next.any():
            return nearest
        nearest[start[is_next]] = nearest[end[is_next]]
        is_reached[start[is_next]] = True
