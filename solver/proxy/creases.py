# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a surface has no normal: in sharp creases and corners.

The normal of a vertex in the edge of a box lies between its two sides, and the cubic term would turn
it toward one of them: a box, which is cubic already, would lose its edges. On a fine surface the
vertices beside the crease know the normals of both sides, so the crease itself may be silent.
"""

import numpy as np

from ..edge_vectors import double_area_vectors, edge_vectors

FULL = np.cos(np.radians(25.0))
"""the normal counts where those of the faces around are within 25 degrees of it, on average..."""
NONE = np.cos(np.radians(40.0))
"""...and not at all beyond 40: the edge of a box has 45"""


def smoothness(V, F, C):
    """Return how much the normal of each vertex means, (n,), from 0 in a crease to 1.

    The normals of the triangles are weighted by their angles at the vertex, so that the result does
    not depend on how the sides of a box are triangulated.

    Parameters
    ----------
    V : (n,3) float array
    F : (m,3) int array
    C : (m,3) float array
        Cotangents of the corner angles.
    """
    sums, total = np.zeros((len(V), 3)), np.zeros(len(V))
    for block, edges in edge_vectors(V, F):
        vectors = double_area_vectors(edges)
        lengths = np.linalg.norm(vectors, axis=0)
        unit = vectors / np.where(lengths > 0.0, lengths, 1.0)
        for k in range(3):
            corner, angle = F[block, k], np.arctan2(1.0, C[block, k]) * (lengths > 0.0)
            total += np.bincount(corner, angle, len(V))
            for c in range(3):
                sums[:, c] += np.bincount(corner, angle * unit[c], len(V))
    coherence = np.linalg.norm(sums, axis=1) / np.where(total > 0.0, total, 1.0)
    t = np.clip((coherence - NONE) / (FULL - NONE), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
