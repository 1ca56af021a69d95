# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the sides of the form face on an object."""

import numpy as np

from ...solver.pieces.placement import Placement
from ...solver.styles.style import Style

_LEAST_SHARE = 0.25
"""of a region: a triangle with less does not face its sides"""


def form_directions(style: Style) -> np.ndarray:
    """Return the outward unit normals (k,3) of the sides of the form, where it is solved."""
    axes = np.asarray(style.orientation)  # the rows of Q, which maps into the frame of the form
    if not style.forms:
        return np.concatenate([axes, -axes]) + 0.0
    return style.forms[0].normals @ axes


def directions_at(
    placement: Placement, triangles: np.ndarray, shares: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray | None]:
    """Return the directions of the form and of all regions, and which count for each triangle.

    `triangles`: (m,3) int. `shares`: (n,1+r), from `region_shares`, or None without regions.
    Returns `directions`: (k,3), as of `form_directions`; `counts`: (m,k) bool, or None if all count
    everywhere.
    """
    if shares is None:
        return form_directions(placement.style), None
    found = [form_directions(style) for style in placement.styles]
    part = np.repeat(np.arange(len(found)), [len(some) for some in found])
    is_there = shares[triangles].mean(axis=1) >= _LEAST_SHARE
    return np.concatenate(found), is_there[:, part]
