# SPDX-License-Identifier: GPL-3.0-or-later
"""What is solved at once: an object by itself, or several that are kept together.

`read_member` and `prepare` change nothing.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate
from typing import Protocol, TypeVar

import bpy
import numpy as np

from .. import solver
from ..solver.components import components
from ..solver.mesh_checks import check_mesh
from . import handles, mesh_bridge
from .object_frame import Placement, placement_alone, placement_in_world
from .requirements import check_requirements
from .settings import Settings


@dataclass(frozen=True)
class Shape:
    """What is read once from a mesh: the original shape and its virtual triangulation."""

    original: np.ndarray
    """(n,3) float32 positions, object space"""
    triangles: np.ndarray
    """(m,3) int"""

    def is_like(self, other: Shape) -> bool:
        """Tell whether both are the same, bit for bit."""
        if self is other:
            return True
        is_same = self.original.tobytes() == other.original.tobytes()
        return is_same and np.array_equal(self.triangles, other.triangles)

    @cached_property
    def components(self):
        """Number of connected parts, loose vertices not counted."""
        count = len(self.original)
        used = np.unique(self.triangles)
        return components(self.triangles, count)[0] - (count - len(used))


@dataclass(frozen=True)
class Member:
    """One object of an assembly, free of references to Blender's data."""

    uid: int
    """``session_uid`` of the object"""
    name: str
    shape: Shape
    settings: Settings
    alone: Placement
    in_world: Placement | None
    """None where it cannot be solved with others"""
    handle_of: np.ndarray
    """(n,) int, the number of the handle that holds each vertex, or -1"""
    map_weights: np.ndarray | float
    """(n,) factors of the cubeness, or 1"""
    seconds: float
    """that reading it took"""

    @property
    def vertices(self):
        """Number of vertices."""
        return len(self.shape.original)

    @property
    def triangles(self):
        """Number of triangles of the virtual triangulation."""
        return len(self.shape.triangles)

    @property
    def components(self):
        """Number of connected parts, loose vertices not counted."""
        return self.shape.components

    @property
    def is_held(self):
        """(n,) bool, the vertices that handles hold."""
        return self.handle_of >= 0

    @property
    def is_still(self):
        """(n,) bool, the vertices that nothing asks to change.

        Where the map is 0. Not where a handle is posed: then the rest is asked to follow.
        """
        if any(handle.matrix != handles.IDENTITY for handle in self.settings.handles):
            return np.zeros(self.vertices, dtype=bool)
        return np.broadcast_to(np.asarray(self.map_weights) == 0.0, self.vertices)


@dataclass(frozen=True)
class Prepared:
    """What is done once per shapes, placements and handles of an assembly."""

    members: tuple[Member, ...]
    placements: tuple[Placement, ...]
    """where each member is solved"""
    setup: solver.Setup
    is_still: np.ndarray
    """(N,) bool, what the setup was made with"""
    seconds: float

    @property
    def name(self):
        """What to call it in messages."""
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
        """Whether nothing is asked to change at all."""
        return bool(self.is_still.all())

    @property
    def settings(self):
        """Those of the first member, for what all have in common."""
        return self.members[0].settings

    def with_cubeness(self, cubeness: float) -> Prepared:
        """Return the same, to be solved at another cubeness."""
        members = tuple(
            replace(member, settings=replace(member.settings, cubeness=cubeness))
            for member in self.members
        )
        return replace(self, members=members)

    def parts(self) -> Iterator[tuple[Member, Placement, slice]]:
        """Give each member with its placement and its part of the arrays."""
        ends = list(accumulate(member.vertices for member in self.members))
        for member, placement, end in zip(self.members, self.placements, ends, strict=True):
            yield member, placement, slice(end - member.vertices, end)


class Joinable(Protocol):
    """What `assemblies` puts together."""

    @property
    def settings(self) -> Settings:
        """The settings of the object."""
        ...

    @property
    def in_world(self) -> Placement | None:
        """None where it cannot be solved with others."""
        ...


T = TypeVar("T", bound=Joinable)


def assemblies(items: Sequence[T]) -> list[list[T]]:
    """Return objects by what is solved at once, in the order of the first of each."""
    joined = [item for item in items if _is_joined(item)]
    return [
        joined if _is_joined(item) else [item]
        for item in items
        if not _is_joined(item) or item is joined[0]
    ]


def _is_joined(item):
    return item.settings.together == "SELECTION" and item.in_world is not None


def read_shape(obj: bpy.types.Object) -> Shape:
    """Read the original shape of an object.

    Raises
    ------
    CubicCraftError
        The object cannot be used; the message names it and the cure.
    """
    check_requirements()
    mesh_bridge.check_editable(obj)
    mesh = mesh_bridge.mesh_of(obj)
    original = mesh_bridge.original_positions(mesh)
    return Shape(original, mesh_bridge.triangles(mesh, original))


def read_member(
    obj: bpy.types.Object,
    settings: Settings,
    known: Member | None = None,
    *,
    weights_changed: bool = False,
) -> Member:
    """Read and check an object.

    Parameters
    ----------
    obj, settings
    known : Member, optional
        Of the same object: what has not changed since is taken from it. The shape never has.
    weights_changed : bool
        The weights of vertex groups may have.

    Raises
    ------
    CubicCraftError
        The object or a setting cannot be used; the message names the object and the cure.
    """
    begin = time.perf_counter()
    alone, in_world = placement_alone(obj, settings), placement_in_world(obj, settings)
    shape = known.shape if known else read_shape(obj)
    if known is None or known.alone.shape_key != alone.shape_key:
        _check_alone(obj.name, alone, shape)
    if weights_changed:
        known = None
    return Member(
        obj.session_uid,
        obj.name,
        shape,
        settings,
        alone,
        in_world,
        _handle_of(obj, settings, known),
        _map_weights(obj, settings, known),
        time.perf_counter() - begin,
    )


def prepare(members: Sequence[Member], earlier: Sequence[Prepared] = ()) -> Prepared:
    """Factorise what is to be solved at once.

    Parameters
    ----------
    members : sequence of Member
        A single one is solved in its own coordinates, several in world space.
    earlier : sequence of Prepared
        What has not changed since is taken from them.

    Raises
    ------
    CubicCraftError
        They cannot be solved; the message names the objects.
    """
    begin = time.perf_counter()
    placements = _placements(members)
    is_still = np.concatenate([member.is_still for member in members])
    is_held = np.concatenate([member.is_held for member in members])
    try:
        rest = _rest(members, placements, earlier)
        setup = next(
            (other.setup for other in earlier if _has_setup(other, rest, is_held, is_still)), None
        )
        if setup is None:
            # Somewhere the solver needs a vertex that is free.
            is_some_free = not (is_still | is_held).all()
            still = is_still if is_some_free and is_still.any() else None
            setup = solver.Setup(rest, np.flatnonzero(is_held), still)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f"{_listed([m.name for m in members])}: {error}") from error
    seconds = time.perf_counter() - begin + sum(member.seconds for member in members)
    return Prepared(tuple(members), placements, setup, is_still, seconds)


def _placements(members):
    if len(members) == 1:
        return (members[0].alone,)
    return tuple(member.in_world for member in members if member.in_world is not None)


def _rest(members, placements, earlier):
    """Build the RestMesh, or take an earlier one of the same shapes: its links are known."""
    proxy = members[0].settings.proxy
    for other in earlier:
        if not _has_shapes(other, members, placements):
            continue
        before, rest = other.settings.proxy, other.setup.rest
        if before == proxy:
            return rest
        if replace(before, solidity=proxy.solidity) == proxy:
            return rest.with_solidity(proxy.solidity)
    positions, triangles, count = [], [], 0
    for member, placement in zip(members, placements, strict=True):
        F = member.shape.triangles
        positions.append(placement.place(member.shape.original))
        triangles.append(count + (F[:, ::-1] if placement.is_mirrored else F))
        count += member.vertices
    return solver.rest_mesh(np.concatenate(positions), np.concatenate(triangles), proxy)


def _has_shapes(prepared, members, placements):
    if len(prepared.members) != len(members):
        return False
    pairs = zip(prepared.members, members, strict=True)
    is_same = all(one.shape.is_like(other.shape) for one, other in pairs)
    places = zip(prepared.placements, placements, strict=True)
    return is_same and all(one.shape_key == other.shape_key for one, other in places)


def _has_setup(prepared, rest, is_held, is_still):
    if prepared.setup.rest is not rest or not np.array_equal(prepared.is_still, is_still):
        return False
    return np.array_equal(np.concatenate([m.is_held for m in prepared.members]), is_held)


def _check_alone(name, placement, shape):
    """Refuse a shape for itself, so that it does not spoil an assembly, which cannot tell whose."""
    try:
        check_mesh(placement.place(shape.original), shape.triangles)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{name}": {error}') from error


def _handle_of(obj, settings, known):
    groups = [handle.members for handle in settings.handles]
    if known and groups == [handle.members for handle in known.settings.handles]:
        return known.handle_of
    return handles.handle_of(obj, settings.handles)


def _map_weights(obj, settings, known):
    if not settings.map_group:
        return 1.0
    choice = (settings.map_group, settings.map_invert)
    if known and choice == (known.settings.map_group, known.settings.map_invert):
        return known.map_weights
    weights = mesh_bridge.group_weights(obj, settings.map_group)
    return 1.0 - weights if settings.map_invert else weights


def _listed(names):
    quoted = [f'"{name}"' for name in names]
    if len(quoted) > 3:
        return f"{quoted[0]}, {quoted[1]} and {len(quoted) - 2} others"
    return " and ".join(filter(None, [", ".join(quoted[:-1]), quoted[-1]]))
