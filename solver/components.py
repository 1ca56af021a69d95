# SPDX-License-Identifier: GPL-3.0-or-later
"""Connected components: parts that share no triangle."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components


def components(F, n):
    """Return the number of components and the component of each vertex, ``(n,)`` int32.

    F : (m,3) int array of triangles. A vertex in no triangle is a component of its own.
    """
    rows = F[:, [0, 1]].ravel()
    columns = F[:, [1, 2]].ravel()
    graph = sp.coo_matrix((np.ones(len(rows), np.int8), (rows, columns)), shape=(n, n))
    count, labels = connected_components(graph, directed=False)
    return int(count), labels
