# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface of one object at rest."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..aliases import FloatArray, IntArray
from ..mesh.catmull_clark import Cage
from ..values import is_same
from .reflection import Reflection
from .subdivided import Subdivided
from .whole import Whole

LEAST_MATCHING = 0.99
"""share of the vertices that must have mirror images in a shape that is symmetric"""
_KEPT = 8  # wholes of one shape
_NEARLY = 0.02  # of the extent: difference of the distances of the bounding box's sides


@dataclass(frozen=True, eq=False)
class Shape:
    """Positions of an object at rest, and its triangles."""

    original: FloatArray
    """(n,3) positions, in the coordinates of the object; Blender's are float32"""
    triangles: IntArray
    """(m,3) int"""
    cage: Cage | None = None
    """its faces, if what is seen is the smooth surface of it"""
    faces: IntArray | None = None
    """(m,) int the face of the mesh that each triangle is a piece of; None if all are whole"""

    def is_like(self, other: "Shape") -> bool:
        """Return whether both are the same, bit for bit."""
        values = ([x.original, x.triangles, x.cage, x.faces] for x in (self, other))
        return self is other or is_same(*values)

    def whole(
        self, reflections: Sequence[Reflection], symmetry: Sequence[bool], *, is_smooth: bool
    ) -> Whole:
        """Return its Whole, of a cage that `is_smooth` its Subdivided, the same each time."""
        cage = self.cage if is_smooth else None
        given = tuple(reflections), tuple(symmetry)
        key = (*given, cage is None)
        if key not in self._wholes:
            while len(self._wholes) >= _KEPT:  # the object of a Mirror modifier may be dragged
                del self._wholes[next(iter(self._wholes))]
            own = self.original, self.triangles, *given
            made = Whole(*own, self.faces) if cage is None else Subdivided(*own, cage)
            self._wholes[key] = made
        return self._wholes[key]

    @cached_property
    def _wholes(self):
        return {}

    @cached_property
    def symmetric_axes(self) -> tuple[bool, ...]:
        """About which planes through the origin it is symmetric."""
        return tuple(self._is_symmetric(axis) for axis in range(3))

    def _is_symmetric(self, axis):
        x = self.original[:, axis]
        if len(x) < 3 or not abs(x.min() + x.max()) <= _NEARLY * np.ptp(x):
            return False  # by this, most meshes are known not to be
        axes = [number == axis for number in range(3)]
        matching = self.whole((), axes, is_smooth=False).matching or 0
        return matching >= LEAST_MATCHING * len(x)

    @cached_property
    def components(self) -> int:
        """Number of connected parts, loose vertices not counted."""
        from ..mesh.components import components

        count = len(self.original)
        used = np.unique(self.triangles)
        return components(self.triangles, count)[0] - (count - len(used))
