# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances between vertices along the edges of a mesh, and between points."""

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import KDTree

from ..aliases import FloatArray, IntArray
from .edges import edges_of


def edge_distances(
    V: FloatArray, F: IntArray, seeds: ArrayLike, limit: float = np.inf
) -> FloatArray:
    """Return the length of the shortest path along edges to the nearest of the seeds.

    Parameters
    ----------
    V : (n,3) numpy array
    F : (m,3) numpy int array
    seeds : (k,) numpy int array
        Vertices with the distance 0.
    limit : float
        Vertices farther away have an infinite distance, as have those that are not connected.

    Returns
    -------
    (n,) numpy array

    See Also
    --------
    nearest_distances : Distances in a straight line.

    Notes
    -----
    This is Dijkstra's algorithm ("A note on two problems in connexion with graphs", Numerische
    Mathematik 1, 1959), as implemented in SciPy.

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


def nearest_distances(points: ArrayLike, others: ArrayLike) -> FloatArray:
    """Return the distance of each point from the nearest of the others.

    Parameters
    ----------
    points : (n,3) numpy array
    others : (k,3) numpy array

    Returns
    -------
    (n,) numpy array

    See Also
    --------
    edge_distances : Distances along the edges of a mesh.

    Examples
    --------
    >>> from solver import nearest_distances
    >>> nearest_distances([[0, 0, 0], [5, 0, 0]], [[0, 0, 1], [9, 0, 0]])
    array([1., 4.])
    """
    distance, _ = KDTree(others).query(points)
    return distance
