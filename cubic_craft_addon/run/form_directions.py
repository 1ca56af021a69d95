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
    placement = placement_alone(obj, settings)
    axes = placement.orientation  # the rows of Q, which maps into the frame of the form
    if placement.form is None:
        return np.concatenate([axes, -axes]) + 0.0
    return placement.form.normals @ axes
