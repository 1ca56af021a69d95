# SPDX-License-Identifier: GPL-3.0-or-later
"""One object of an assembly, read from Blender into plain arrays.

`read_member` changes nothing.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import bpy
import numpy as np

from ... import solver
from ...solver.mesh.components import components
from ...solver.mesh.mesh_checks import check_mesh
from .. import handles, mesh_bridge
from ..environment.requirements import check_requirements
from ..handles.reach import far_from, grown
from ..settings.values import Settings
from .bones import Bones, read_bones, read_posed_bones
from .object_frame import Placement, placements
from .region_shares import region_shares
from .whole import Whole, modifier_reflections


@dataclass(frozen=True)
class Shape:
    """The data read once from a mesh: the original shape and its virtual triangulation."""

    original: np.ndarray
    """(n,3) float32 positions, object space"""
    triangles: np.ndarray
    """(m,3) int"""
    start: mesh_bridge.Start = "HERE"
    """which shape was read if the mesh was edited by hand since its last result"""

    def is_like(self, other: Shape) -> bool:
        """Return whether both are the same, bit for bit."""
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
    whole: Whole
    """the shape with the vertices that its Mirror modifier adds"""
    settings: Settings
    alone: Placement
    in_world: Placement | None
    """None if it cannot be solved with others"""
    handle_of: np.ndarray
    """(n,) int, the number of the handle that holds each vertex, or -1"""
    rest_weights: np.ndarray | None
    """(n,) weights of the vertices far from moved handles; None if all may move"""
    map_weights: np.ndarray | float
    """(n,) factors of the cubeness, or 1"""
    region_shares: np.ndarray | None
    """(n,1+k) shares of the object's own settings and of each of its k regions; None for k = 0"""
    bones: Bones | None
    """the bones that move it, None without *Keep Pose*"""
    seconds: float
    """time to read it"""

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
        """(n,) bool, the vertices that handles hold exactly."""
        is_exact = [not handle.is_cubic for handle in self.settings.handles]
        return np.array([*is_exact, False])[self.handle_of]  # the last is of those in none

    def of_whole(self, values):
        """Return values (n,...) of the vertices, or one for all, at all that are solved (N,...)."""
        return np.broadcast_to(values, (self.vertices, *np.shape(values)[1:]))[self.whole.source]

    @property
    def is_still(self):
        """(n,) bool, the vertices that should not change.

        Those where the map is 0. If a handle is posed, there are none: the rest should follow.
        """
        if any(handle.is_moved for handle in self.settings.handles):
            return np.zeros(self.vertices, dtype=bool)
        return np.broadcast_to(np.asarray(self.map_weights) == 0.0, self.vertices)


def parts_of(
    members: Sequence[Member], placements: Sequence[Placement]
) -> Iterator[tuple[Member, Placement, slice]]:
    """Yield each member of an assembly with its placement and its part of the arrays.

    The part begins with the vertices of the member, followed by added ones.
    """
    end = 0
    for member, placement in zip(members, placements, strict=True):
        begin, end = end, end + len(member.whole.source)
        yield member, placement, slice(begin, end)


def read_shape(obj: bpy.types.Object, start: mesh_bridge.Start = "HERE") -> Shape:
    """Read the original shape of an object.

    Parameters
    ----------
    obj
    start : {"HERE", "ORIGINAL", "EDITS"}
        Which shape is the original if the mesh was edited by hand since its last result.

    Raises
    ------
    CubicCraftError
        The object cannot be used; the message names it and the remedy.
    """
    check_requirements()
    mesh_bridge.check_editable(obj)
    mesh = mesh_bridge.mesh_of(obj)
    original = mesh_bridge.original_positions(mesh, start)
    return Shape(original, mesh_bridge.triangles(mesh, original), start)


def read_member(
    obj: bpy.types.Object,
    settings: Settings,
    known: Member | None = None,
    *,
    weights_changed: bool = False,
    rigged: bpy.types.Object | None = None,
) -> Member:
    """Read and check an object.

    Parameters
    ----------
    obj, settings
    known : Member, optional
        Of the same object: unchanged data is reused. The shape has not changed.
    weights_changed : bool
        Whether the weights of vertex groups may have changed.
    rigged : Object, optional
        The object whose visible mesh this is, in the pose that it has now.

    Raises
    ------
    CubicCraftError
        The object or a setting cannot be used; the message names the object and the remedy.
    """
    begin = time.perf_counter()
    alone, in_world = placements(obj, settings, is_posed=rigged is not None)
    shape = known.shape if known else read_shape(obj, settings.start)
    if known is None or known.alone.shape_key != alone.shape_key:
        _check_alone(obj.name, alone, shape)
    if known is not None and known.alone.shape_key != alone.shape_key:
        known = None
    reflections = modifier_reflections(obj)
    if weights_changed:
        known = None
    V = alone.place(shape.original)
    handle_of = _handle_of(obj, settings, V, shape.triangles, known)
    whole = _whole(shape, reflections, settings, known)
    return Member(
        obj.session_uid,
        obj.name,
        shape,
        whole,
        settings,
        alone,
        in_world,
        handle_of,
        _rest_weights(settings, V, shape.triangles, handle_of, known),
        _map_weights(obj, settings, known),
        _region_shares(obj, settings, known),
        _bones(obj, settings, whole, alone, shape, known, rigged),
        time.perf_counter() - begin,
    )


def _check_alone(name, placement, shape):
    """Refuse an invalid shape here, because an assembly could not name the object."""
    try:
        check_mesh(placement.place(shape.original), shape.triangles)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{name}": {error}') from error


def _handle_of(obj, settings, V, F, known):
    if known and _groups(settings) == _groups(known.settings):
        return known.handle_of
    return grown(handles.handle_of(obj, settings.handles), settings.handles, V, F)


def _rest_weights(settings, V, F, handle_of, known):
    moved = [n for n, handle in enumerate(settings.handles) if handle.is_moved]
    if not settings.hold_rest or not moved:
        return None
    if known and known.handle_of is handle_of and known.rest_weights is not None:
        before = [n for n, handle in enumerate(known.settings.handles) if handle.is_moved]
        if before == moved:
            return known.rest_weights
    return far_from(np.flatnonzero(np.isin(handle_of, moved)), V, F)


def _groups(settings):
    return [handle.members for handle in settings.handles]


def _map_weights(obj, settings, known):
    if not settings.map_group:
        return 1.0
    choice = (settings.map_group, settings.map_invert)
    if known and choice == (known.settings.map_group, known.settings.map_invert):
        return known.map_weights
    weights = mesh_bridge.group_weights(obj, settings.map_group)
    return 1.0 - weights if settings.map_invert else weights


def _region_shares(obj, settings, known):
    groups = [region.group for region in settings.regions]
    if known and groups == [region.group for region in known.settings.regions]:
        return known.region_shares
    return region_shares(obj, settings)


def _bones(obj, settings, whole, alone, shape, known, rigged):
    if not settings.keep_pose:
        return None
    if rigged is not None:
        return read_posed_bones(obj, shape.original, whole, alone, rigged)
    return read_bones(obj, shape.original, whole, alone, known and known.bones)


def _whole(shape, reflections, settings, known):
    before = known and (known.whole.reflections, known.settings.symmetry)
    if known and known.shape is shape and before == (reflections, settings.symmetry):
        return known.whole
    return Whole(shape.original, shape.triangles, reflections, settings.symmetry)
