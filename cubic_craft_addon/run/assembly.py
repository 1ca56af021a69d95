# SPDX-License-Identifier: GPL-3.0-or-later
"""What is solved together: a single object, or several that are kept together.

`prepare` changes nothing.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol, TypeVar

import numpy as np

from ... import solver
from ..settings.values import Settings
from .holds import Hold, holds_of
from .member import Member, parts_of
from .object_frame import Placement


@dataclass(frozen=True)
class Prepared:
    """Everything that is computed once per shapes, placements and handles of an assembly."""

    members: tuple[Member, ...]
    placements: tuple[Placement, ...]
    """where each member is solved"""
    setup: solver.Setup
    is_still: np.ndarray
    """(N,) bool, the held vertices that the setup was made with"""
    without_holds: solver.Setup
    """the setup before groups were held"""
    holds: Sequence[Hold]
    seconds: float

    @property
    def name(self):
        """The name for messages."""
        return _listed([member.name for member in self.members])

    @property
    def vertices(self):
        """Number of vertices."""
        return sum(member.vertices for member in self.members)

    @property
    def triangles(self):
        """Number of triangles of the virtual triangulations."""
        return sum(member.triangles for member in self.members)

    @property
    def components(self):
        """Number of connected parts, loose vertices not counted."""
        return sum(member.components for member in self.members)

    @property
    def is_idle(self):
        """Whether the settings change nothing at all."""
        return bool(self.is_still.all())

    @property
    def settings(self):
        """Those of the first member, for the settings that all share."""
        return self.members[0].settings

    def with_cubeness(self, cubeness: float) -> Prepared:
        """Return the same with another cubeness."""
        members = tuple(
            replace(member, settings=replace(member.settings, cubeness=cubeness))
            for member in self.members
        )
        return replace(self, members=members)

    def posed(self, members: Sequence[Member]) -> Prepared:
        """Return the same objects in another pose and with other settings, without a factorisation.

        Parameters
        ----------
        members : sequence of Member
            With the shape and the placements of that pose; the rest is as in the first.
        """
        begin = time.perf_counter()
        placements = _placements(members)
        setup = self.without_holds.posed(_placed(members, placements))
        holds = holds_of(members, placements, setup.rest)
        without_holds = setup
        if holds:
            setup = setup.with_holds([hold.weights for hold in holds])
        seconds = time.perf_counter() - begin
        return replace(
            self,
            members=tuple(members),
            placements=placements,
            setup=setup,
            without_holds=without_holds,
            holds=holds,
            seconds=seconds,
        )

    def parts(self) -> Iterator[tuple[Member, Placement, slice]]:
        """Yield each member with its placement and its part of the arrays, see `parts_of`."""
        return parts_of(self.members, self.placements)


class Joinable(Protocol):
    """What `assemblies` groups."""

    @property
    def settings(self) -> Settings:
        """The settings of the object."""
        ...

    @property
    def in_world(self) -> Placement | None:
        """None if it cannot be solved with others."""
        ...


T = TypeVar("T", bound=Joinable)


def assemblies(items: Sequence[T]) -> list[list[T]]:
    """Return the objects that are solved together, in the order of the first of each group."""
    joined = [item for item in items if _is_joined(item)]
    return [
        joined if _is_joined(item) else [item]
        for item in items
        if not _is_joined(item) or item is joined[0]
    ]


def _is_joined(item):
    return item.settings.together == "SELECTION" and item.in_world is not None


def prepare(members: Sequence[Member], earlier: Sequence[Prepared] = ()) -> Prepared:
    """Factorise an assembly.

    Parameters
    ----------
    members : sequence of Member
        A single member is solved in its own coordinates, several in world space.
    earlier : sequence of Prepared
        Unchanged data is reused.

    Raises
    ------
    CubicCraftError
        They cannot be solved; the message names the objects.
    """
    begin = time.perf_counter()
    placements = _placements(members)
    is_still = np.concatenate([member.of_whole(member.is_still) for member in members])
    is_held = _is_held(members)
    try:
        rest = _rest(members, placements, earlier)
        setup = next(
            (
                other.without_holds
                for other in earlier
                if _has_setup(other, members, rest, is_still)
            ),
            None,
        )
        if setup is None:
            # The solver needs at least one free vertex.
            is_some_free = not (is_still | is_held).all()
            still = is_still if is_some_free and is_still.any() else None
            mirrors = _mirrors(members, placements)
            setup = solver.Setup(rest, np.flatnonzero(is_held), still, mirrors)
        without_holds, holds = setup, holds_of(members, placements, rest)
        if holds:
            setup = _with_holds(setup, holds, earlier)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f"{_listed([m.name for m in members])}: {error}") from error
    seconds = time.perf_counter() - begin + sum(member.seconds for member in members)
    return Prepared(tuple(members), placements, setup, is_still, without_holds, holds, seconds)


def _placements(members):
    if len(members) == 1:
        return (members[0].alone,)
    return tuple(member.in_world for member in members if member.in_world is not None)


def _rest(members, placements, earlier):
    """Build the RestMesh, or reuse an earlier one of the same shapes with its links."""
    proxy = members[0].settings.proxy
    for other in earlier:
        if not _has_shapes(other, members, placements):
            continue
        rest = other.setup.rest.with_options(proxy)
        if rest is not None:
            return rest
    triangles = []
    for member, placement, part in parts_of(members, placements):
        F = member.whole.triangles
        triangles.append(part.start + (F[:, ::-1] if placement.is_mirrored else F))
    return solver.rest_mesh(_placed(members, placements), np.concatenate(triangles), proxy)


def _placed(members, placements):
    """Return the shapes of all members (N,3) where they are solved."""
    return np.concatenate(
        [
            placement.place(member.whole.images(member.shape.original))
            for member, placement in zip(members, placements, strict=True)
        ]
    )


def _has_shapes(prepared, members, placements):
    if len(prepared.members) != len(members):
        return False
    is_same = all(
        one.whole.added == other.whole.added and one.shape.is_like(other.shape)
        for one, other in zip(prepared.members, members, strict=True)
    )
    places = zip(prepared.placements, placements, strict=True)
    return is_same and all(one.shape_key == other.shape_key for one, other in places)


def _has_setup(prepared, members, rest, is_still):
    if prepared.setup.rest is not rest or not np.array_equal(prepared.is_still, is_still):
        return False
    pairs = zip(prepared.members, members, strict=True)
    if any(one.whole.mirrored != other.whole.mirrored for one, other in pairs):
        return False
    return np.array_equal(_is_held(prepared.members), _is_held(members))


def _with_holds(setup, holds, earlier):
    """Return a Setup with groups, or reuse an earlier one if only their goals have changed."""
    for other in earlier:
        if other.without_holds is setup and len(other.holds) == len(holds):
            pairs = zip(other.holds, holds, strict=True)
            if all(np.array_equal(one.weights, two.weights) for one, two in pairs):
                return other.setup
    return setup.with_holds([hold.weights for hold in holds])


def _is_held(members):
    """Return which of the solved vertices handles hold."""
    return np.concatenate([member.of_whole(member.is_held) for member in members])


def _mirrors(members, placements):
    """Return the Mirrors of all members in the coordinates in which they are solved."""
    total, found = sum(len(member.whole.source) for member in members), []
    for member, placement, part in parts_of(members, placements):
        whole = member.whole
        for reflection, partner in zip(whole.mirrored, whole.partners, strict=True):
            everywhere = np.full(total, solver.NO_PARTNER)
            everywhere[part] = np.where(partner >= 0, partner + part.start, solver.NO_PARTNER)
            found.append(placement.mirror(reflection.mirror(everywhere)))
    return found


def _listed(names):
    quoted = [f'"{name}"' for name in names]
    if len(quoted) > 3:
        return f"{quoted[0]}, {quoted[1]} and {len(quoted) - 2} others"
    return " and ".join(filter(None, [", ".join(quoted[:-1]), quoted[-1]]))
