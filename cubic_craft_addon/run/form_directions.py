# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the sides of the form face on an object."""

import numpy as np

from .object_frame import Placement


def form_directions(placement: Placement) -> np.ndarray:
    """Return the outward unit normals (k,3) of the sides of the form, where it is solved."""
    axes = placement.orientation  # the rows of Q, which maps into the frame of the form
    if placement.form is None:
        return np.concatenate([axes, -axes]) + 0.0
    return placement.form.normals @ axes
