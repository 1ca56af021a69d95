# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep on Floor: parts that stand on the ground before Cubify also do so afterwards."""

from typing import TYPE_CHECKING

import numpy as np

from ..aliases import FloatArray

if TYPE_CHECKING:  # SciPy is loaded when it is needed, not for its names
    from ..setup import Setup

_STANDING = 0.01
"""share of the total height that a standing part may begin above the lowest point"""


def kept_on_floor(setup: "Setup", positions: FloatArray, up: FloatArray) -> FloatArray:
    """Return positions (N,3) of a run, with each standing component moved back to its height.

    The lowest point of a component that begins where the whole does keeps its height. Other
    components do not move, and neither do those with held vertices.

    Parameters
    ----------
    setup
    positions : (N,3) array, where the run has taken the vertices of the input
    up : (3,) array, unit vector
    """
    rest = setup.rest
    used, place = rest.place
    component = rest.topology.component[place]
    before = rest.input_positions[used] @ up
    lowest = _lowest(before, component, rest.topology.component_count)
    drop = lowest - _lowest(positions[used] @ up, component, rest.topology.component_count)
    limit = lowest.min() + _STANDING * np.ptp(before)
    drop[setup.is_anchored | (lowest > limit)] = 0.0
    kept = positions.copy()
    kept[used] += drop[component][:, None] * up
    return kept


def _lowest(heights, component, count):
    """Return the least of the heights (n,) in each component, (count,)."""
    lowest = np.full(count, np.inf)
    np.minimum.at(lowest, component, heights)
    return lowest
