# SPDX-License-Identifier: GPL-3.0-or-later
"""How far vertices are from some of them, along the edges of the mesh."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import KDTree

from .proxy.edges import edges_of


def edge_distances(V, F, seeds, limit=np.inf):
    """Return the length of the shortest way (n,) along edges to the nearest of the seeds.

    Parameters
    ----------
    V : (n,3) array
    F : (m,3) int array
    seeds : (k,) int array
    limit : float
        What is further away is at infinity, as is what is not connected.
    """
    edges, _ = edges_of(F.ravel(), F[:, [1, 2, 0]].ravel(), len(V))
    lengths = np.linalg.norm(V[edges[:, 0]] - V[edges[:, 1]], axis=1)
    # An edge of no length would be none at all.
    lengths = np.maximum(lengths, 1e-12 * max(lengths.max(initial=0.0), 1e-300))
    graph = sp.csr_matrix((lengths, (edges[:, 0], edges[:, 1])), shape=(len(V), len(V)))
    return dijkstra(graph, directed=False, indices=seeds, limit=limit, min_only=True)


def nearest_distances(points, others):
    """Return the distance (n,) of each point (n,3) from the nearest of the others (k,3)."""
    distance, _ = KDTree(others).query(points)
    return distance
