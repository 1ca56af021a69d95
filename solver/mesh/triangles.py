# SPDX-License-Identifier: GPL-3.0-or-later
"""What several steps of the set-up need of the triangles of a surface, computed once."""

import numpy as np

from .edges import Edges
from .rest_measures import triangle_areas_and_normals


class Triangles:
    """The triangles of a surface, with what is asked of them.

    Its Edges, and its areas and normals as `triangle_areas_and_normals` returns them. Not kept in a
    `RestMesh`: of a million vertices this would be 300 MB.

    `V`: (n,3) float, positions in the unit box. `F`: (m,3) int.
    """

    def __init__(self, V, F):
        self.V, self.F = V, F
        self.edges = Edges(F, len(V))
        self.areas, self.normals = triangle_areas_and_normals(V, F)

    def parts(self, part):
        """Return the part (m,) of each triangle from those of the vertices (n,)."""
        return part[self.F[:, 0]]


def distinct(F):
    """Return the triangles with three different corners, one of each set of corners."""
    return F[distinct_rows(F)]


def distinct_rows(F):
    """Return which triangles (k,) have three different corners, one of each set of corners."""
    rows = np.flatnonzero((F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0]))
    corners = np.sort(F[rows].astype(np.int64), axis=1)
    order = np.lexsort(corners.T[::-1])
    ordered = corners[order]
    is_new = np.ones(len(rows), dtype=bool)
    is_new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    return rows[np.sort(order[is_new])]
