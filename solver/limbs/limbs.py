# SPDX-License-Identifier: GPL-3.0-or-later
"""Which way each vertex of a body lies."""

from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np
import scipy.sparse as sp

from ..aliases import BoolArray, FloatArray
from ..rotation_fit import svd_rotations
from ..values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Limbs(Value):
    """Straight pieces of limbs, and how far each vertex belongs to each of them."""

    directions: FloatArray
    """(s,3) unit vectors along the pieces, to either end, which their frames are found from.

    Zero for a piece with the frame of the object."""
    shares: sp.csr_matrix
    """(n,s) of each vertex in each piece. What is left to 1 belongs to no limb: to a trunk"""
    carried: FloatArray | None = field(default=None, kw_only=True)
    """(s,3,3) rotations that have carried the pieces, with their frames, to where they are now.

    A limb that bends is one box, and one that moves does not spin about itself."""

    def __len__(self) -> int:
        return len(self.directions)

    def posed(self, V: FloatArray, posed: FloatArray) -> Self:
        """Return the Limbs of another pose: the pieces turn as their vertices do.

        `V`, `posed`: (n,3), positions in this pose and in the other.
        """
        weight = np.asarray(self.shares.sum(axis=0))[0][:, None]
        means, others = ((self.shares.T @ x) / np.maximum(weight, 1e-300) for x in (V, posed))
        products = self.shares.T @ (V[:, :, None] * posed[:, None, :]).reshape(-1, 9)
        M = products.reshape(-1, 3, 3) - weight[:, :, None] * means[:, :, None] * others[:, None, :]
        return self.turned(svd_rotations(M))

    def turned(self, rotations: FloatArray) -> Self:
        """Return the Limbs with the pieces carried on by rotations (s,3,3)."""
        return replace(self, carried=rotations @ self.all_carried)

    @property
    def all_carried(self) -> FloatArray:
        """(s,3,3) `carried`, the identity where they are none."""
        return np.tile(np.eye(3), (len(self), 1, 1)) if self.carried is None else self.carried

    @property
    def present(self) -> FloatArray:
        """(s,3) the directions where the pieces are now."""
        return np.einsum("sij,sj->si", self.all_carried, self.directions)

    def replaced(self, is_replaced: BoolArray, other: "Limbs") -> "Limbs":
        """Return the Limbs in which some vertices, a mask (n,), have those of others."""
        own = sp.diags(np.where(is_replaced, 0.0, 1.0)) @ self.shares
        others = sp.diags(np.where(is_replaced, 1.0, 0.0)) @ other.shares
        directions = np.concatenate([self.directions, other.directions])
        carried = np.concatenate([self.all_carried, other.all_carried])
        return Limbs(directions, sp.csr_matrix(sp.hstack([own, others])), carried=carried)


@dataclass(frozen=True, eq=False, repr=False)
class KnownLimbs(Limbs):
    """Limbs that are known for some of the vertices, as from bones by `limbs_of_bones`.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy.sparse import csr_matrix
    >>> from solver import KnownLimbs
    >>> along_x = np.array([[1.0, 0, 0]])
    >>> arm = KnownLimbs(along_x, csr_matrix([[1.0], [0.0]]), np.array([True, False]))
    >>> len(arm), arm.present.tolist()
    (1, [[1.0, 0.0, 0.0]])
    """

    known: BoolArray
    """(n,) bool; the rows of all others are zero"""


def no_limbs(count: int) -> Limbs:
    """Return the Limbs of a body of `count` vertices that has none."""
    return Limbs(np.empty((0, 3)), sp.csr_matrix((count, 0)))
