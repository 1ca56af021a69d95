# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge vectors of the triangles, a block at a time.

Meshes of a million vertices must not fill the memory, and what fits into the cache is computed in a
fraction of the time.
"""

import numpy as np

BLOCK = 1 << 13
"""triangles; a few dozen float64 arrays of this length fit into the cache of a core"""


def edge_vectors(V, F):
    """Yield ``block, edges`` for all triangles.

    `V`: (n,d), positions, or some of their coordinates. `F`: (m,3) int, triangles. Gives `block`:
    slice, rows of F; `edges`: (3,d,b), ``edges[k, c]`` is coordinate c of the edges opposite corner
    k, which run from corner k+1 to corner k+2.
    """
    coordinates = np.array(V.T, dtype=np.float64, order="C")
    for begin in range(0, len(F), BLOCK):
        block = slice(begin, begin + BLOCK)
        corners = F[block].T.astype(np.intp, order="C")
        edges = np.empty((3, len(coordinates), corners.shape[1]))
        for c, x in enumerate(coordinates):
            at = x.take(corners)
            for k in range(3):
                np.subtract(at[k - 1], at[k - 2], out=edges[k, c])
        yield block, edges


def double_area_vectors(edges):
    """Return the normals (3,b) of a block of triangles, as long as twice their area."""
    (ax, ay, az), (bx, by, bz) = edges[1], edges[2]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])


def area_vectors(V, F):
    """Return the normals (m,3) of triangles (m,3) of positions (n,3), as long as twice the area."""
    vectors = np.empty((len(F), 3))
    for block, edges in edge_vectors(V, F):
        vectors[block] = double_area_vectors(edges).T
    return vectors
