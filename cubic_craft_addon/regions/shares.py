# SPDX-License-Identifier: GPL-3.0-or-later
"""How much each vertex belongs to the regions of its object."""

from collections.abc import Sequence

import bpy
import numpy as np

from .. import mesh_bridge
from .region import Region


def region_shares(obj: bpy.types.Object, regions: Sequence[Region]) -> np.ndarray | None:
    """Return the shares (n,1+k) of the object's own settings and of each of its k regions.

    They add up to 1: what the weights of the regions leave is the object's, and where they are more
    than 1 together, they are scaled. None for an object without regions.

    Raises CubicCraftError: a vertex group does not exist.
    """
    if not regions:
        return None
    weights = [mesh_bridge.group_weights(obj, region.group) for region in regions]
    weights = np.stack(weights, axis=1)
    total = weights.sum(axis=1, keepdims=True)
    rest = np.maximum(1.0 - total, 0.0)
    return np.concatenate([rest, weights / np.maximum(total, 1.0)], axis=1)
