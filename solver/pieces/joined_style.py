# SPDX-License-Identifier: GPL-3.0-or-later
"""The style of several pieces: what each of their vertices is turned toward.

Arrays are indexed by the vertices that are solved: those of the pieces, in order, each with those
that its mirrors add.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..aliases import FloatArray, IntArray
from ..styles.blending import blended, numbered
from ..styles.cube import proper
from ..styles.forms import cube
from ..styles.polytope import Polytope
from ..styles.style import Style
from .mirrored_styles import orientations
from .piece import Piece


def joined_style(pieces: Sequence[Piece]) -> Style:
    """Return what the vertices of all pieces are turned toward."""
    found, counts = [_of_piece(piece) for piece in pieces], [piece.solved for piece in pieces]
    style = Style(_joined_cubeness(found, counts), _joined(found, counts))
    style = _with_hardening(style, pieces)
    distinct, number = numbered([body for one in found for body in one.bodies])
    if not any(distinct):
        if style.is_plain_cube:
            style = replace(style, orientation=proper(np.asarray(style.orientation)))
        return style
    ends = np.cumsum([len(one.bodies) for one in found])[:-1]
    form_of = [
        np.broadcast_to(own[one.body_of], count)
        for one, own, count in zip(found, np.split(number, ends), counts, strict=True)
    ]
    bodies = [body or cube() for body in distinct]
    return replace(style, form=bodies, form_of=np.concatenate(form_of))


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
    first = found[0].orientation[0]
    # Ignore rounding errors of world matrices.
    if all(np.allclose(style.orientation, first, rtol=0.0, atol=1e-6) for style in found):
        return first
    pairs = zip(found, counts, strict=True)
    return np.concatenate(
        [np.broadcast_to(style.orientation, (count, 3, 3)) for style, count in pairs]
    )


def _with_hardening(style, pieces):
    """Return a style with the crispness and the strength of details of all pieces."""
    styles = [piece.placement.style for piece in pieces]
    has_weights = any(np.ndim(piece.detail_weights) for piece in pieces)
    is_given = any(one.crispness or one.detail_strength != 1.0 for one in styles)
    if not is_given and not has_weights:
        return style
    crispness, strength = [], []
    for piece, one in zip(pieces, styles, strict=True):
        crispness.append(piece.everywhere(one.crispness * np.minimum(piece.map_weights, 1.0)))
        strength.append(piece.everywhere(one.detail_strength * piece.detail_weights))
    return replace(
        style, crispness=np.concatenate(crispness), detail_strength=np.concatenate(strength)
    )
