# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a surface encloses a volume, as a printer needs it. This knows nothing of Blender."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Faults:
    """The edges at which a surface is not closed."""

    open: int
    """edges of one triangle: they surround holes"""
    crowded: int
    """edges of three triangles or more"""
    flipped: int
    """edges of two triangles, one of which is inside out"""
    is_inside_out: bool
    """whether the surface is closed, but faces the volume that it encloses"""

    def in_words(self) -> str:
        """Return what is wrong, empty if nothing is."""
        counts = (
            (self.open, "at holes"),
            (self.crowded, "with more than two faces"),
            (self.flipped, "between faces that are turned against each other"),
        )
        parts = [f"{count:,} edge{'s' * (count > 1)} {where}" for count, where in counts if count]
        if parts:
            return "is not closed: " + ", ".join(parts)
        return "is inside out" if self.is_inside_out else ""


def find_faults(V: np.ndarray, F: np.ndarray) -> Faults:
    """Count the edges that keep a surface from being closed.

    Vertices at the same place count as one, because an STL file has no vertices, only corners:
    what is cut along seams is closed there.

    `V`: (n,3) float32. `F`: (m,3) int.
    """
    places = np.unique(V, axis=0, return_inverse=True)[1].reshape(-1)
    triangles = places[F]
    first, second, third = triangles.T
    triangles = triangles[(first != second) & (second != third) & (third != first)]
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    is_forward = edges[:, 0] < edges[:, 1]
    keys = np.sort(edges, axis=1)
    _, edge_of, counts = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    forward = np.bincount(edge_of.reshape(-1), weights=is_forward, minlength=len(counts))
    is_open, is_crowded = counts == 1, counts > 2
    is_flipped = (counts == 2) & (forward != 1)
    is_closed = not (is_open | is_crowded | is_flipped).any()
    return Faults(
        int(is_open.sum()),
        int(is_crowded.sum()),
        int(is_flipped.sum()),
        is_closed and bool(_volume(V, F) < 0),
    )


def _volume(V: np.ndarray, F: np.ndarray) -> float:
    """Return the enclosed volume, negative if the surface is inside out."""
    centered = V.astype(np.float64) - V.mean(axis=0)
    a, b, c = (centered[F[:, corner]] for corner in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)
