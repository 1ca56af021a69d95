# SPDX-License-Identifier: GPL-3.0-or-later
"""The energy that is minimized, in its two parts."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Energy:
    """Energies in the unit box (divide lengths by the largest extent of the mesh).

    Examples
    --------
    >>> from solver import Energy
    >>> Energy(arap=0.25, cubic=0.5).total
    0.75
    """

    arap: float
    """of the as-rigid-as-possible deformation"""
    cubic: float
    """of the normals, which is lowest along the axes of the cube"""

    @property
    def total(self) -> float:
        """The energy that is minimized."""
        return self.arap + self.cubic
