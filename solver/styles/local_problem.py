# SPDX-License-Identifier: GPL-3.0-or-later
"""The problem of the local step, one per vertex."""

from typing import NamedTuple

import numpy as np

from .cube import cost


class LocalProblem(NamedTuple):
    """min over R in SO(3) of lam |Q R n|_1 - tr(R S), of n vertices at once."""

    S: np.ndarray
    """(n,3,3) covariances, divided by the vertex areas"""
    normals: np.ndarray
    """(n,3) unit normals, or zero where `lam` is"""
    Q: np.ndarray
    """(n,3,3) orientations of the cube"""
    lam: np.ndarray
    """(n,) cubeness"""

    def part(self, rows):
        """Return the problems of some rows, by number or mask."""
        return LocalProblem(*(values[rows] for values in self))

    def cube_normals(self, R):
        """Return the rotated normals Q R n (n,3) in the frame of the cube."""
        rotated = np.einsum("nij,nj->ni", R, self.normals)
        return np.einsum("nij,nj->ni", self.Q, rotated)

    def costs(self, R):
        """Return tr(R S) and |Q R n|_1, both (n,)."""
        return np.einsum("nij,nji->n", R, self.S), cost(self.cube_normals(R))

    def is_worse(self, R, last):
        """Return where R (n,3,3) costs more than `last`: taking it would raise the energy."""
        (fit, now), (last_fit, before) = self.costs(R), self.costs(last)
        return self.lam * now - fit > self.lam * before - last_fit
