# SPDX-License-Identifier: GPL-3.0-or-later
"""A coarser mesh of the same shape, and the vertices that were merged into each of its own."""

import numpy as np

from .optional_packages import optional_package

MOST_LEFT = 0.7
"""of the vertices; more, and levels without end would follow each other"""


def decimate(V, F, ratio):
    """Collapse edges by their quadric error (Garland and Heckbert, 1997).

    Parameters
    ----------
    V : (n,3) float array
        Positions, about the size of the unit box.
    F : (m,3) int array
        Triangles that use all vertices.
    ratio : float
        Factor by which to reduce the number of triangles.

    Returns
    -------
    V : (k,3) float array
    F : (l,3) int array
    cluster : (n,) int array
        The vertex of the result that each vertex has been merged into, one that a triangle uses.

    None where the package fast-simplification is missing, nothing is left of the mesh, or almost
    all of it is, because it cannot get coarser.
    """
    package = optional_package("fast_simplification")
    if package is None:
        return None
    coarse_V, coarse_F, collapses = package.simplify(
        V.astype(np.float32),
        F.astype(np.int32),
        target_count=max(int(len(F) / ratio), 4),
        return_collapses=True,
    )
    if len(coarse_V) > MOST_LEFT * len(V):
        return None
    cluster = _clusters(F, len(V), collapses)
    if cluster is None or cluster.max() >= len(coarse_V):
        return None
    return coarse_V.astype(np.float64), coarse_F, cluster


def _clusters(F, n, collapses):
    """Return the number (n,) of the vertex that each vertex has been merged into, or None.

    The package numbers the vertices that still are in a triangle, in their order.
    """
    into = np.arange(n)
    into[collapses[:, 1]] = collapses[:, 0]
    is_left = into == np.arange(n)
    while not is_left[into].all():  # a vertex may be merged into one that is merged later
        into = into[into]
    F = into[F]
    is_triangle = (F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])
    is_used = np.zeros(n, dtype=bool)
    is_used[F[is_triangle]] = True
    if not is_used.any():
        return None
    # A vertex that has lost all its triangles is merged into a neighbour.
    F = F[~is_used[F].all(axis=1)]  # few
    edges = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    edges = np.concatenate([edges, edges[:, ::-1]])
    edges = edges[~is_used[edges[:, 0]] & is_used[edges[:, 1]]]
    merged = np.arange(n)
    merged[edges[:, 0]] = edges[:, 1]
    number = np.cumsum(is_used) - 1
    number[~is_used] = 0  # a collapsed part: its start does not matter
    return number[merged[into]]
