# SPDX-License-Identifier: GPL-3.0-or-later
"""What is symmetric at rest stays so, without being asked.

Samples of links and the order of sums are never exactly symmetric, and a tail between two sides of
a cube goes to either of them.
"""

from dataclasses import replace
from typing import TypeVar

import numpy as np

from ..aliases import FloatArray
from ..surface.symmetry import Mirror
from .mirrored_styles import is_own_image
from .piece import Piece
from .reflection import flip
from .subdivided import Subdivided

_ALIKE = 0.01  # of weights

T = TypeVar("T", bound=Piece)


def with_own_symmetry(piece: T, up: FloatArray | None = None) -> T:
    """Return a piece that is solved alone, symmetric about the axes about which it is at rest.

    With a direction `up` (3,), where it is solved, only about planes that contain it: what keeps
    its place on the floor is shifted afterward.

    Neither where its form is not its own image, nor where handles, regions or painted weights are
    not symmetric. One with a symmetry that was asked for stays as it is.
    """
    whole = piece.whole
    if whole.matching is not None or piece.may_lose_symmetry:
        return piece
    axes = tuple(
        is_symmetric and is_own_image(flip(axis), piece.placement, up)
        for axis, is_symmetric in enumerate(piece.shape.symmetric_axes)
    )
    if not any(axes):
        return piece
    is_smooth = isinstance(whole, Subdivided)
    found = piece.shape.whole(whole.reflections, axes, is_smooth=is_smooth)
    if not all(_is_even(piece, mirror) for mirror in found.own_partners):
        return piece
    return replace(piece, whole=found)


def _is_even(piece: Piece, mirror: Mirror):
    """Return whether what is given for each vertex is the same for its partner."""
    has_one = mirror.partner >= 0
    partner = mirror.partner[has_one]
    is_in_handle = piece.handle_of >= 0
    if (is_in_handle[has_one] != is_in_handle[partner]).any():
        return False
    for weights in map(np.asarray, (piece.map_weights, piece.detail_weights)):
        if weights.ndim and np.abs(weights[has_one] - weights[partner]).max() > _ALIKE:
            return False
    return True
