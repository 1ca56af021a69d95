# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of each vertex that is solved.

Arrays are indexed by the `N` vertices of the solver's input: those of the members, in order, each
with those that its Mirror modifier adds.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ... import solver
from ...solver.styles.blending import Style, blended, numbered
from ...solver.styles.cube import proper
from ...solver.styles.forms import cube
from ...solver.styles.polytope import Polytope
from .. import handles
from .assembly import Prepared
from .mirrored_cubes import orientations


class Styles(NamedTuple):
    """What each vertex is turned toward, as `solver.Stylization` takes it."""

    cubeness: float | np.ndarray
    """a number, or (N,) of them"""
    orientation: np.ndarray
    """(3,3), or (N,3,3) if they differ; beyond a plane of symmetry, forms are also mirrored"""
    form: list[Polytope] | None
    """None if all are cubes"""
    form_of: np.ndarray | None
    """(N,) int, the number of the form of each vertex"""


def styles(prepared: Prepared) -> Styles:
    """Return what each vertex is turned toward."""
    found = [_of_member(member, placement) for member, placement, _ in prepared.parts()]
    counts = [len(member.whole.source) for member in prepared.members]
    cubeness, orientation = _joined_cubeness(found, counts), _joined(found, counts)
    distinct, number = numbered([body for style in found for body in style.bodies])
    if not any(distinct):
        if not any(placement.capture for placement in prepared.placements):
            orientation = proper(orientation)
        return Styles(cubeness, orientation, None, None)
    ends = np.cumsum([len(style.bodies) for style in found])[:-1]
    form_of = [
        np.broadcast_to(own[style.body_of], count)
        for style, own, count in zip(found, np.split(number, ends), counts, strict=True)
    ]
    bodies = [body or cube() for body in distinct]
    return Styles(cubeness, orientation, bodies, np.concatenate(form_of))


class _OfMember(NamedTuple):
    cubeness: float | np.ndarray
    orientation: np.ndarray
    bodies: list
    body_of: np.ndarray


def _of_member(member, placement):
    settings, factor = member.settings, member.map_weights
    places = (placement, *placement.regions)
    turned = orientations(member.whole, places)
    if member.region_shares is None:
        cubeness = settings.cubeness * factor
        if not isinstance(factor, float):
            cubeness = member.of_whole(cubeness)
        return _OfMember(cubeness, turned[0], [placement.form], np.zeros(1, int))
    values = [settings.cubeness, *(region.cubeness for region in settings.regions)]
    all_styles = [
        Style(value, Q, place.form) for value, Q, place in zip(values, turned, places, strict=True)
    ]
    cubeness, Q, bodies, body_of = blended(all_styles, member.of_whole(member.region_shares))
    return _OfMember(cubeness * member.of_whole(factor), Q, bodies, body_of)


def _joined_cubeness(found, counts):
    values = [style.cubeness for style in found]
    if all(isinstance(value, float) and value == values[0] for value in values):
        return values[0]
    return np.concatenate(
        [np.broadcast_to(value, count) for value, count in zip(values, counts, strict=True)]
    )


def _joined(found, counts):
    """Return the orientations of all vertices, or one for all."""
    first = found[0].orientation[0]
    # Ignore rounding errors of world matrices.
    if all(np.allclose(style.orientation, first, rtol=0.0, atol=1e-6) for style in found):
        return first
    return np.concatenate(
        [
            np.broadcast_to(style.orientation, (count, 3, 3))
            for style, count in zip(found, counts, strict=True)
        ]
    )


def targets(prepared: Prepared) -> np.ndarray:
    """Return the targets (N,3) of the vertices by the handles."""
    return np.concatenate(
        [
            placement.place(
                member.whole.images(
                    handles.targets(
                        member.shape.original, member.handle_of, member.settings.handles
                    )
                )
            )
            for member, placement, _ in prepared.parts()
        ]
    )


def known_limbs(prepared: Prepared) -> solver.KnownLimbs | None:
    """Return the limbs that bones tell, None if there are none."""
    if not any(member.bones for member in prepared.members):
        return None
    limbs = [
        member.bones and member.bones.limbs_at(placement)
        for member, placement, _ in prepared.parts()
    ]
    return solver.joined_limbs(limbs, [len(member.whole.source) for member in prepared.members])
