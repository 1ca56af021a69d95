# SPDX-License-Identifier: GPL-3.0-or-later
"""Reorder the vertices of a large mesh so that neighbors are close to each other in memory.

The speed of an iteration depends on memory access to neighbors. Programs that subdivide
append the new vertices, far from the old ones. In the order of Cuthill and McKee (1969) the set-up,
the local step and the products with sparse matrices take half the time (400,000 vertices), and an
iteration a third less (25,000).
"""

import numpy as np
import scipy.sparse as sp

LEAST_VERTICES = 20_000
"""Smaller meshes fit into the cache in any order."""


def vertex_order(F, n):
    """Return the order (n,) int of the vertices of triangles F (m,3), or None to keep it.

    Vertices of a component come one after the other.
    """
    if n < LEAST_VERTICES:
        return None
    from scipy.sparse.csgraph import reverse_cuthill_mckee  # takes long to import

    start, end = F.ravel(), F[:, [1, 2, 0]].ravel()
    edges = sp.coo_matrix((np.ones(len(start), np.int8), (start, end)), shape=(n, n))
    # a closed surface has each edge in both directions, and any order will do at a boundary
    return reverse_cuthill_mckee(edges.tocsr(), symmetric_mode=True)
