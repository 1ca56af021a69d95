# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a proxy."""

import math
from dataclasses import dataclass, fields, replace

from ..errors import CubicCraftError
from ..inputs import real_number, switch
from ..method import PAPER as AS_IN_PAPER
from ..method import Method


@dataclass(frozen=True, kw_only=True)
class ProxyOptions:
    """How `rest_mesh` prepares a surface for the solver.

    The defaults are those of the extension. `PAPER` turns everything off.

    Raises
    ------
    CubicCraftError
        The solidity or the detail is negative or not finite, or an option has another
        type.

    Examples
    --------
    >>> from solver import PAPER, ProxyOptions
    >>> ProxyOptions()  # doctest: +ELLIPSIS
    ProxyOptions(solidity=0.3, together=True, refine=True, keep_pose=True, detail=0.05,...
    >>> PAPER.solidity, PAPER.refine, PAPER.detail
    (0.0, False, 0.0)
    """

    solidity: float = Method.solidity
    """how firmly limbs, walls and volume keep their thickness; 0 is a hollow surface"""
    together: bool = Method.together != "OFF"
    """whether to merge vertices at the same place and to link parts that are close together"""
    refine: bool = Method.refine == "AUTO"
    """whether to split coarse meshes, ignore the normals of creases and preserve boxes"""
    keep_pose: bool = Method.keep_pose
    """whether limbs become boxes along themselves, so that they keep their direction"""
    detail: float = Method.detail
    """size of the features that ride along instead of being flattened, as a share of the largest
    extent; 0 flattens all"""
    keep_apart: bool = Method.keep_apart
    """whether surfaces that do not cross at rest are kept from crossing"""

    def __post_init__(self):
        for each in fields(self):
            value = getattr(self, each.name)
            if isinstance(each.default, bool):
                switch(value, each.name)
            elif not (math.isfinite(real_number(value, each.name)) and value >= 0.0):
                raise CubicCraftError(f"{each.name} must be finite and not negative, not {value}")

    @property
    def needs_thickness(self) -> bool:
        """Whether the other side of each part has to be found."""
        return self.solidity > 0.0 or self.detail > 0.0 or self.keep_pose


def proxy_of(method: Method) -> ProxyOptions:
    """Return the options that are among the settings of a run; what is not OFF is on."""
    values = {each.name: getattr(method, each.name) for each in fields(ProxyOptions)}
    return ProxyOptions(**{n: x != "OFF" if isinstance(x, str) else x for n, x in values.items()})


PAPER = proxy_of(replace(Method(), **AS_IN_PAPER))
"""the energy of the paper, on the surface exactly as it is given"""
