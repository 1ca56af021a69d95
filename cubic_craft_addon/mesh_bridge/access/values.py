# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties of all members of a collection of Blender at once."""

from typing import Any

import numpy as np


def read_values(collection: Any, name: str, kind: Any = np.float32, width: int = 1) -> np.ndarray:
    """Read a property of all members of a collection, (k,) or with a width (k,width)."""
    flat = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, flat)
    return flat if width == 1 else flat.reshape(-1, width)
