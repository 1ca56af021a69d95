# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the sides of the form face on an object."""

import bpy
import numpy as np

from ..settings.values import Settings
from .object_frame import placement_alone


def form_directions(obj: bpy.types.Object, settings: Settings) -> np.ndarray:
    """Return the outward unit normals (k,3) of the sides of the form.

    They are given where flatness is seen: in the coordinates of `placement_alone`, those of the
    object stretched by its scale.

    Raises
    ------
    CubicCraftError
        As `stretch_and_orientation`.
    """
    orientation = placement_alone(obj, settings).orientation
    # The rows of Q, which maps into the frame of the cube, are the axes of the cube.
    return np.concatenate([orientation, -orientation]) + 0.0
