# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a proxy."""

from dataclasses import dataclass

import numpy as np

from ..errors import CubicCraftError


@dataclass(frozen=True, kw_only=True)
class ProxyOptions:
    """How to prepare a surface for the solver.

    The defaults are those of the extension. `PAPER` turns everything off.

    Raises
    ------
    CubicCraftError
        The solidity is negative or not finite.

    See Also
    --------
    rest_mesh : Builds the proxy with these options.

    Examples
    --------
    >>> from solver import PAPER, ProxyOptions
    >>> ProxyOptions()
    ProxyOptions(solidity=0.1, together=True, refine=True)
    >>> ProxyOptions(solidity=0.0, together=False, refine=False) == PAPER
    True
    """

    solidity: float = 0.1
    """how firmly limbs, walls and volume keep their thickness; 0 is a hollow surface"""
    together: bool = True
    """whether to merge vertices at the same place and to link parts that are close together"""
    refine: bool = True
    """whether to split coarse meshes, ignore the normals of creases and preserve boxes"""

    def __post_init__(self):
        if not (np.isfinite(self.solidity) and self.solidity >= 0.0):
            raise CubicCraftError(f"solidity must be finite and not negative, not {self.solidity}")


PAPER = ProxyOptions(solidity=0.0, together=False, refine=False)
"""the energy of the paper, on the surface exactly as it is given"""
