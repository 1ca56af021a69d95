# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups that keep their place as a whole while their surface becomes cubic."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ... import solver
from .member import Member, parts_of
from .object_frame import Placement


@dataclass(frozen=True)
class Hold:
    """A group of vertices, and its goal."""

    weights: np.ndarray
    """(N,) of all vertices that are solved"""
    matrix: np.ndarray
    """(4,4), in the coordinates in which they are solved"""


def holds_of(
    members: Sequence[Member], placements: Sequence[Placement], rest: solver.RestMesh
) -> list[Hold]:
    """Return all groups of an assembly.

    The vertices far from moved handles are a group in each component with such a handle, unless
    another handle stays in place and already anchors it. Components without handles float in
    place.
    """
    total, found = len(rest.input_positions), []
    component = np.full(total, -1)
    used, place = rest.place
    component[used] = rest.topology.component[place]
    for member, placement, part in parts_of(members, placements):
        for own, matrix in _groups(member, placement, component[part]):
            weights = np.zeros(total)
            weights[part] = own
            found.append(Hold(weights, matrix))
    return found


def _groups(member: Member, placement: Placement, component: np.ndarray) -> Iterator:
    """Yield the weights of all solved vertices of a member, and a matrix, for each group."""
    handle_of = member.of_whole(member.handle_of)
    handles = member.settings.handles
    into = placement.matrix
    for number, handle in enumerate(handles):
        if not handle.is_cubic:
            continue
        pose = np.reshape(handle.matrix, (4, 4))
        # Beyond the plane of a Mirror modifier, the motion is mirrored.
        for is_there, reflection in member.whole.elements():
            weights = ((handle_of == number) & is_there).astype(np.float64)
            if weights.any():
                way = into @ reflection
                yield weights, way @ pose @ np.linalg.inv(way)
    if member.rest_weights is not None:
        weights = np.where(
            member.of_whole(member.is_held), 0.0, member.of_whole(member.rest_weights)
        )
        is_moved = np.array([*(handle.is_moved for handle in handles), False])[handle_of]
        stays = component[(handle_of >= 0) & ~is_moved]
        for number in np.setdiff1d(component[is_moved], [-1, *stays]):
            far = np.where(component == number, weights, 0.0)
            if far.any():
                yield far, np.eye(4)
