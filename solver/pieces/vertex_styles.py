# SPDX-License-Identifier: GPL-3.0-or-later
"""What each vertex of several pieces is turned toward.

Arrays are indexed by the vertices that are solved: those of the pieces, in order, each with those
that its mirrors add.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ..aliases import FloatArray, IntArray
from ..styles.blending import blended, numbered
from ..styles.cube import proper
from ..styles.forms import cube
from ..styles.polytope import Polytope
from .mirrored_styles import orientations
from .piece import Piece


class VertexStyles(NamedTuple):
    """What each vertex is turned toward, as `Stylization` takes it."""

    cubeness: float | FloatArray
    """a number, or (N,) of them"""
    orientation: FloatArray
    """(3,3), or (N,3,3) if they differ; beyond a plane of symmetry, forms are also mirrored"""
    form: list[Polytope] | None
    """None if all are cubes"""
    form_of: IntArray | None
    """(N,) int, the number of the form of each vertex"""


def vertex_styles(pieces: Sequence[Piece]) -> VertexStyles:
    """Return what each vertex is turned toward."""
    found, counts = [_of_piece(piece) for piece in pieces], [piece.solved for piece in pieces]
    cubeness, orientation = _joined_cubeness(found, counts), _joined(found, counts)
    distinct, number = numbered([body for style in found for body in style.bodies])
    if not any(distinct):
        if not any(piece.placement.capture for piece in pieces):
            orientation = proper(orientation)
        return VertexStyles(cubeness, orientation, None, None)
    ends = np.cumsum([len(style.bodies) for style in found])[:-1]
    form_of = [
        np.broadcast_to(own[style.body_of], count)
        for style, own, count in zip(found, np.split(number, ends), counts, strict=True)
    ]
    bodies = [body or cube() for body in distinct]
    return VertexStyles(cubeness, orientation, bodies, np.concatenate(form_of))


class _OfPiece(NamedTuple):
    cubeness: float | FloatArray
    orientation: FloatArray
    bodies: list[Polytope | None]
    body_of: IntArray


def _of_piece(piece):
    style, factor = piece.placement.style, piece.map_weights
    turned = orientations(piece.whole, piece.placement)
    if piece.region_shares is None:
        cubeness = style.cubeness * factor
        if not isinstance(factor, float):
            cubeness = piece.everywhere(cubeness)
        return _OfPiece(cubeness, turned[0], [style.form], np.zeros(1, int))
    pairs = zip(piece.placement.styles, turned, strict=True)
    all_styles = [replace(one, orientation=Q) for one, Q in pairs]
    cubeness, Q, bodies, body_of = blended(all_styles, piece.everywhere(piece.region_shares))
    return _OfPiece(cubeness * piece.everywhere(factor), Q, bodies, body_of)


def _joined_cubeness(found, counts):
    values = [style.cubeness for style in found]
    if all(isinstance(value, float) and value == values[0] for value in values):
        return values[0]
    pairs = zip(values, counts, strict=True)
    return np.concatenate([np.broadcast_to(value, count) for value, count in pairs])


def _joined(found, counts):
    """Return the orientations of all vertices, or one for all."""
    first = found[0].orientation[0]
    # Ignore rounding errors of world matrices.
    if all(np.allclose(style.orientation, first, rtol=0.0, atol=1e-6) for style in found):
        return first
    pairs = zip(found, counts, strict=True)
    return np.concatenate(
        [np.broadcast_to(style.orientation, (count, 3, 3)) for style, count in pairs]
    )


def captures(pieces: Sequence[Piece]) -> dict[str, Any]:
    """Return the arguments of a Stylization for the captures of all pieces, none for no capture.

    Where the cubeness map is 0, nothing has to face anywhere.
    """
    found = [piece.placement.capture for piece in pieces]
    distinct = list(dict.fromkeys(capture for capture in found if capture is not None))
    if not distinct:
        return {}
    numbers, strengths = [], []
    for piece, capture in zip(pieces, found, strict=True):
        strength = 0.0 if capture is None else piece.capture_strength
        strengths.append(piece.everywhere(strength * piece.map_weights))
        number = 0 if capture is None else distinct.index(capture)
        numbers.append(np.full(piece.solved, number))
    return {
        "capture": distinct,
        "capture_strength": np.concatenate(strengths),
        "capture_of": np.concatenate(numbers),
    }
