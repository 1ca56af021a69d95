# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh as it may come from anywhere: nothing about it can be relied on."""

from dataclasses import dataclass, field

import numpy as np


@dataclass
class BrokenMesh:
    """Positions, faces with any number of corners, and what lies in no face."""

    V: np.ndarray
    """(n,3) float64 positions"""
    faces: list[tuple[int, ...]]
    edges: list[tuple[int, int]] = field(default_factory=list)
    """edges in no face"""
    notes: list[str] = field(default_factory=list)
    """how it was made, for whoever reads of a failure"""

    @property
    def triangles(self):
        """Fans of the faces, (m,3) int: of concave faces they overlap, which is welcome here."""
        fans = [(f[0], f[k], f[k + 1]) for f in self.faces for k in range(1, len(f) - 1)]
        return np.array(fans, dtype=np.int64).reshape(-1, 3)

    @property
    def loose(self):
        """(n,) bool: vertices in no face."""
        is_loose = np.ones(len(self.V), dtype=bool)
        is_loose[[i for face in self.faces for i in face]] = False
        return is_loose

    def joined(self, other):
        """Return this mesh and another one as one of several parts."""
        first = len(self.V)
        return BrokenMesh(
            np.concatenate([self.V, other.V]),
            self.faces + [tuple(first + i for i in face) for face in other.faces],
            self.edges + [(first + i, first + j) for i, j in other.edges],
            self.notes + other.notes,
        )

    def __repr__(self):
        """Tell how it was made: thousands of numbers would tell less."""
        counts = f"{len(self.V)} vertices, {len(self.faces)} faces, {len(self.edges)} loose edges"
        return f"<{' + '.join(self.notes)}: {counts}>"

    def _repr_pretty_(self, printer, cycle):
        printer.text(repr(self))  # Hypothesis would print all fields
