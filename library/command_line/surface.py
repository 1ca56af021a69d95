# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface with faces of any size, as it is read from a file."""

from dataclasses import dataclass, field

import numpy as np

from solver.mesh.polygons import triangulate


@dataclass(frozen=True)
class Surface:
    """What is stylized."""

    points: np.ndarray
    """(n,3) float64"""
    faces: list[np.ndarray]
    """blocks (k,s) int of faces with s corners each, in the order of the file"""
    triangles: np.ndarray = field(init=False)
    """(m,3) int, a virtual triangulation of the faces"""

    def __post_init__(self):
        with np.errstate(over="ignore", invalid="ignore"):  # infinite ones the solver refuses
            parts = [triangulate(self.points, block) for block in self.faces]
        triangles = np.concatenate(parts) if parts else np.empty((0, 3), np.int64)
        object.__setattr__(self, "triangles", triangles)

    @property
    def face_count(self) -> int:
        """Number of faces."""
        return sum(len(block) for block in self.faces)
