# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a proxy."""

import math
from dataclasses import dataclass

from ..errors import CubicCraftError
from ..inputs import real_number, switch


@dataclass(frozen=True, kw_only=True)
class ProxyOptions:
    """How to prepare a surface for the solver.

    The defaults are those of the extension. `PAPER` turns everything off.

    Raises
    ------
    CubicCraftError
        The solidity or the detail is negative or not finite, or an option has another type.

    See Also
    --------
    rest_mesh : Builds the proxy with these options.

    Examples
    --------
    >>> from solver import PAPER, ProxyOptions
    >>> ProxyOptions()  # doctest: +ELLIPSIS
    ProxyOptions(solidity=0.3, together=True, refine=True, keep_pose=True, detail=0.05,...
    >>> PAPER.solidity, PAPER.refine, PAPER.detail
    (0.0, False, 0.0)
    """

    solidity: float = 0.3
    """how firmly limbs, walls and volume keep their thickness; 0 is a hollow surface"""
    together: bool = True
    """whether to merge vertices at the same place and to link parts that are close together"""
    refine: bool = True
    """whether to split coarse meshes, ignore the normals of creases and preserve boxes"""
    keep_pose: bool = True
    """whether limbs become boxes along themselves, so that they keep their direction"""
    detail: float = 0.05
    """size of the features that ride along instead of being flattened, as a share of the largest
    extent; 0 flattens all"""
    keep_apart: bool = True
    """whether surfaces that do not cross at rest are kept from crossing"""

    def __post_init__(self):
        for name in ("solidity", "detail"):
            value = real_number(getattr(self, name), name)
            if not (math.isfinite(value) and value >= 0.0):
                raise CubicCraftError(f"{name} must be finite and not negative, not {value}")
        for name in ("together", "refine", "keep_pose", "keep_apart"):
            switch(getattr(self, name), name)

    @property
    def needs_thickness(self) -> bool:
        """Whether the other side of each part has to be found."""
        return self.solidity > 0.0 or self.detail > 0.0 or self.keep_pose


PAPER = ProxyOptions(
    solidity=0.0, together=False, refine=False, keep_pose=False, detail=0.0, keep_apart=False
)
"""the energy of the paper, on the surface exactly as it is given"""
