# SPDX-License-Identifier: GPL-3.0-or-later
"""Which way each vertex of a body lies."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp


@dataclass(frozen=True)
class Limbs:
    """Straight pieces of limbs, and how far each vertex belongs to each of them.

    See Also
    --------
    limbs_of_shape : Finds them.

    Examples
    --------
    >>> import numpy as np
    >>> from solver.limbs import Limbs
    >>> arm = Limbs(np.array([[1.0, 0, -1]]) / 2**0.5, np.array([[1.0], [0.5], [0.0]]))
    >>> len(arm)
    1
    """

    directions: np.ndarray
    """(s,3) unit vectors along the pieces, to either end"""
    shares: np.ndarray | sp.csr_matrix
    """(n,s) of each vertex in each piece. What is left to 1 belongs to no limb: to a trunk"""

    def __len__(self):
        return len(self.directions)

    def at(self, rows):
        """Return the Limbs of some vertices, by number (k,)."""
        return Limbs(self.directions, self.shares[rows])

    def joined(self, other):
        """Return the Limbs of these vertices, followed by those of others."""
        shares = sp.block_diag([self.shares, other.shares], format="csr")
        return Limbs(np.concatenate([self.directions, other.directions]), shares)


def no_limbs(count):
    """Return the Limbs of a body of `count` vertices that has none."""
    return Limbs(np.empty((0, 3)), np.empty((count, 0)))
