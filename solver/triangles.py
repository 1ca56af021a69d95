# SPDX-License-Identifier: GPL-3.0-or-later
"""What several steps of the set-up need of the triangles of a surface, computed once."""

from .edges import Edges
from .rest_measures import triangle_areas_and_normals


class Triangles:
    """The triangles of a surface, with what is asked of them.

    Not kept in a `RestMesh`: of a million vertices this would be 300 MB.

    Parameters
    ----------
    V : (n,3) float array
        Positions in the unit box.
    F : (m,3) int array

    Attributes
    ----------
    edges : Edges
    measures
        `areas` and `normals`, as `triangle_areas_and_normals` returns them.
    """

    def __init__(self, V, F):
        self.V, self.F = V, F
        self.edges = Edges(F, len(V))
        self.measures = triangle_areas_and_normals(V, F)

    @property
    def areas(self):
        """(m,) float64 array."""
        return self.measures[0]

    @property
    def normals(self):
        """(m,3) unit normals, zero where there is no area."""
        return self.measures[1]

    def parts(self, part):
        """Return the part (m,) of each triangle from those of the vertices (n,)."""
        return part[self.F[:, 0]]
