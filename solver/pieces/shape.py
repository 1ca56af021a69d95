# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface of one object at rest."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..aliases import FloatArray, IntArray
from ..mesh.catmull_clark import Cage


@dataclass(frozen=True, eq=False)
class Shape:
    """Positions of an object at rest, and its triangles."""

    original: FloatArray
    """(n,3) positions, in the coordinates of the object; Blender's are float32"""
    triangles: IntArray
    """(m,3) int"""
    cage: Cage | None = None
    """its faces, if what is seen is the smooth surface of it"""

    def is_like(self, other: "Shape") -> bool:
        """Return whether both are the same, bit for bit."""
        if self is other:
            return True
        is_same = self.original.tobytes() == other.original.tobytes()
        is_same &= other.cage is None if self.cage is None else self.cage.is_like(other.cage)
        return is_same and np.array_equal(self.triangles, other.triangles)

    @cached_property
    def components(self) -> int:
        """Number of connected parts, loose vertices not counted."""
        from ..mesh.components import components

        count = len(self.original)
        used = np.unique(self.triangles)
        return components(self.triangles, count)[0] - (count - len(used))
