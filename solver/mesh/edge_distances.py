# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances between vertices along the edges of a mesh."""

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike
from scipy.sparse.csgraph import dijkstra

from ..aliases import FloatArray, IntArray
from .edges import edges_of


def edge_distances(
    V: FloatArray, F: IntArray, seeds: ArrayLike, limit: float = np.inf
) -> FloatArray:
    """Return the length (n,) of the shortest path along edges to the nearest of the seeds (k,).

    Vertices farther away than the limit have an infinite distance, as have those that are not
    connected.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import edge_distances
    >>> V = np.array([[0.0, 0, 0], [3, 0, 0], [3, 4, 0], [0, 4, 0]])
    >>> edge_distances(V, np.array([[0, 1, 2], [0, 2, 3]]), [1])
    array([3., 0., 4., 7.])
    """
    edges, _ = edges_of(F.ravel(), F[:, [1, 2, 0]].ravel(), len(V))
    lengths = np.linalg.norm(V[edges[:, 0]] - V[edges[:, 1]], axis=1)
    # SciPy ignores edges with a length of zero.
    lengths = np.maximum(lengths, 1e-12 * max(lengths.max(initial=0.0), 1e-300))
    graph = sp.csr_matrix((lengths, (edges[:, 0], edges[:, 1])), shape=(len(V), len(V)))
    return dijkstra(graph, directed=False, indices=seeds, limit=limit, min_only=True)
