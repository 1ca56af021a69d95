# SPDX-License-Identifier: GPL-3.0-or-later
"""Connected components: parts that share no triangle and are not linked."""

import numpy as np


def components(rows, n):
    """Return the number of components of n vertices, and the component of each, ``(n,)`` int32.

    `rows`: (m,k) int, vertices that are connected: the corners of triangles, or pairs. A vertex in
    none is a component of its own. Components are numbered by their first vertex.
    """
    from scipy.sparse import csr_matrix  # here: the extension imports this file when Blender starts
    from scipy.sparse.csgraph import connected_components

    ends = rows[:, :-1].ravel(), rows[:, 1:].ravel()
    graph = csr_matrix((np.ones(len(ends[0]), dtype=bool), ends), shape=(n, n))
    return connected_components(graph, directed=False)
