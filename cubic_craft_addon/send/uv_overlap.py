# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether faces overlap in a UV map. This knows nothing of Blender."""

import numpy as np

_TEXELS = 256  # along a side, at which overlaps are looked for


def overlap(uv: np.ndarray) -> float:
    """Return how much of a UV map is covered more than once.

    `uv`: (m,3,2) of triangles in the unit square. Returns what is covered again, relative to what
    is covered; 1 if nothing is covered.
    """
    counts = np.zeros((_TEXELS, _TEXELS), np.int32)
    places = uv.astype(np.float64) * _TEXELS - 0.5  # centers of texels are whole numbers
    lower = np.ceil(places.min(axis=1)).astype(int).clip(0, _TEXELS)
    upper = np.floor(places.max(axis=1)).astype(int).clip(-1, _TEXELS - 1) + 1
    for corners, (left, bottom), (right, top) in zip(places, lower, upper, strict=True):
        if left < right and bottom < top:
            counts[bottom:top, left:right] += _is_inside(corners, left, right, bottom, top)
    covered = int((counts > 0).sum())
    return (int(counts.sum()) - covered) / covered if covered else 1.0


def _is_inside(corners: np.ndarray, left: int, right: int, bottom: int, top: int) -> np.ndarray:
    """Return which texels (top - bottom, right - left) lie in a triangle, edges excluded."""
    x, y = np.meshgrid(np.arange(left, right), np.arange(bottom, top))
    sides = [
        (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
        for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)
    ]
    return np.logical_and.reduce([side > 0 for side in sides]) | np.logical_and.reduce(
        [side < 0 for side in sides]
    )
