# SPDX-License-Identifier: GPL-3.0-or-later
"""Recognize a shape key that Blender has moved along with its Basis.

Editing Basis in Edit or Sculpt Mode shifts the other keys by the same, rounded to float32: their
offsets from Basis stay, but not to the bit, so a hash cannot tell. A few sums of all offsets,
each with its own signs, stay nearly the same, and change when any single point is edited.
"""

import hashlib

import numpy as np

_SUMS = 4
_ROUNDING = 2.0**-24  # of float32, relative
_MARGIN = 16.0  # the sums of many roundings spread like the square root of their number


def offset_sums(points: np.ndarray, base: np.ndarray) -> list[float]:
    """Sum up the offsets of a shape key from its base.

    `points`, `base`: (n,3) float32. Returns the number of vertices, the largest coordinate, and 4
    sums in the unit of the coordinates.
    """
    offsets = np.ravel(points).astype(np.float64) - np.ravel(base)
    largest = max(np.abs(points).max(initial=0.0), np.abs(base).max(initial=0.0))
    sums = [float(np.where(signs, offsets, -offsets).sum()) for signs in _signs(offsets.size)]
    return [len(points), float(largest), *sums]


def same_offsets(one: list[float], other: list[float]) -> bool:
    """Return whether two results of `offset_sums` differ by no more than rounding."""
    if len(one) != len(other) or one[0] != other[0]:
        return False
    roundings = np.sqrt(max(3 * one[0], 1)) * _ROUNDING * max(one[1], other[1])
    return bool(np.abs(np.subtract(one[2:], other[2:])).max(initial=0.0) <= _MARGIN * roundings)


def _signs(size: int) -> np.ndarray:
    """Return signs that are the same in all versions of Python and NumPy, as files rely on them."""
    row = -(-size // 8)
    noise = hashlib.shake_128(b"cubic craft").digest(_SUMS * row)
    bits = np.unpackbits(np.frombuffer(noise, np.uint8)).reshape(_SUMS, 8 * row)
    return bits[:, :size].astype(bool)
