# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions as a text: `x y z, x y z`.

Blender's properties have no lists of vectors that operators, Live and objects could share. A text
is copied, saved, undone and compared like every other setting, and scripts can write it.
"""

import numpy as np

from ...solver import CubicCraftError

_DIGITS = 8  # as many as 32 bit numbers have


def write_directions(directions: np.ndarray) -> str:
    """Return unit vectors (k,3) as a text."""
    rows = np.round(directions, _DIGITS) + 0.0  # no negative zeros
    return ", ".join(" ".join(f"{value:.{_DIGITS}g}" for value in row) for row in rows)


def read_directions(text: str) -> np.ndarray:
    """Return the unit vectors (k,3) of a text that is not empty.

    Raises CubicCraftError: these are not vectors with three numbers, or one is zero.
    """
    try:
        rows = np.array([[float(word) for word in row.split()] for row in text.split(",")])
    except ValueError:
        rows = np.empty((0, 0))
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise CubicCraftError(
            f'"{text[:40]}" is not a list of directions; write three numbers for each, such as'
            ' "0 0 1, 1 0 0"'
        )
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    if not (np.isfinite(sizes).all() and (sizes > 0.0).all()):
        raise CubicCraftError("the directions of a form must be finite, and not zero")
    return rows / sizes
