# SPDX-License-Identifier: GPL-3.0-or-later
"""What is asked of a proxy."""

from dataclasses import dataclass

import numpy as np

from ..errors import CubicCraftError


@dataclass(frozen=True, kw_only=True)
class ProxyOptions:
    """How a surface is prepared. `rest_mesh` without any of this is the energy of the paper.

    Raises
    ------
    CubicCraftError
        The solidity is negative or not finite.
    """

    solidity: float = 0.1
    """how far limbs, walls and volume keep their thickness; 0 is a hollow skin"""
    together: bool = True
    """vertices at one place are one, and parts that lie near each other are linked"""
    refine: bool = True
    """coarse meshes are split, creases have no normal, and boxes stay boxes"""

    def __post_init__(self):
        if not (np.isfinite(self.solidity) and self.solidity >= 0.0):
            raise CubicCraftError(f"solidity must be finite and not negative, not {self.solidity}")


PAPER = ProxyOptions(solidity=0.0, together=False, refine=False)
"""the energy of the paper: nothing but the skin as it is given"""
