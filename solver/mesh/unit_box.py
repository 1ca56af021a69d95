# SPDX-License-Identifier: GPL-3.0-or-later
"""Solve in a unit box, whatever the size of the mesh and its distance from the origin.

The energy itself does not depend on the unit: both terms grow with the square of the length.
Rounding errors do, above all in 32 bit. The solver therefore always works on the mesh moved to the
origin and scaled so that its largest extent is 1.
"""

from dataclasses import dataclass

from ..aliases import FloatArray
from ..values import Value


@dataclass(frozen=True, eq=False, repr=False)
class UnitBox(Value):
    """The similarity between the user's coordinates and those of the solver."""

    origin: FloatArray
    """(3,) the corner with the smallest coordinates"""
    size: float
    """largest extent, in the user's unit; 1 where the mesh is a single point"""

    def to_unit(self, V):
        """Return user coordinates (n,3) in the unit box."""
        return (V - self.origin) / self.size

    def from_unit(self, V):
        """Return coordinates (n,3) of the unit box in the user's."""
        return V * self.size + self.origin


def unit_box(V):
    """Return the UnitBox of the positions V (n,3)."""
    origin = V.min(axis=0)
    size = float((V.max(axis=0) - origin).max())
    return UnitBox(origin, size if size > 0.0 else 1.0)
