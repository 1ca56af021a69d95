# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups that keep their place as a whole while their surface becomes cubic."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..aliases import FloatArray
from .piece import Piece, parts_of

if TYPE_CHECKING:  # SciPy is loaded when it is needed, not for its names
    from ..surface.rest import RestMesh


@dataclass(frozen=True)
class Hold:
    """A group of vertices, and its goal."""

    weights: FloatArray
    """(N,) of all vertices that are solved"""
    matrix: FloatArray
    """(4,4), in the coordinates in which they are solved"""


def holds_of(pieces: Sequence[Piece], rest: "RestMesh") -> list[Hold]:
    """Return all groups of pieces that are solved together.

    The vertices far from moved handles are a group in each component with such a handle, unless
    another handle stays in place and already anchors it. Components without handles float in
    place.
    """
    total, found = len(rest.input_positions), []
    component = np.full(total, -1)
    used, place = rest.place
    component[used] = rest.topology.component[place]
    for piece, part in parts_of(pieces):
        for own, matrix in _groups(piece, component[part]):
            weights = np.zeros(total)
            weights[part] = own
            found.append(Hold(weights, matrix))
    return found


def _groups(piece, component):
    """Yield the weights of all solved vertices of a piece, and a matrix, for each group."""
    handle_of, handles = piece.everywhere(piece.handle_of), piece.handles
    into = piece.placement.matrix
    for number, handle in enumerate(handles):
        if not handle.is_cubic:
            continue
        pose = np.reshape(handle.matrix, (4, 4))
        # Beyond the plane of a Mirror modifier, the motion is mirrored.
        for is_there, reflection in piece.whole.elements():
            weights = ((handle_of == number) & is_there).astype(np.float64)
            if weights.any():
                way = into @ reflection
                yield weights, way @ pose @ np.linalg.inv(way)
    if piece.rest_weights is not None:
        is_held = piece.everywhere(piece.is_held)
        weights = np.where(is_held, 0.0, piece.everywhere(piece.rest_weights))
        is_moved = np.array([*(handle.is_moved for handle in handles), False])[handle_of]
        stays = component[(handle_of >= 0) & ~is_moved]
        for number in np.setdiff1d(component[is_moved], [-1, *stays]):
            far = np.where(component == number, weights, 0.0)
            if far.any():
                yield far, np.eye(4)
