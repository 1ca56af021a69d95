# SPDX-License-Identifier: GPL-3.0-or-later
"""One object of an assembly, read from Blender into plain arrays.

`read_member` changes nothing.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import bpy
import numpy as np

from ...solver import CubicCraftError
from ...solver.mesh.mesh_checks import check_mesh
from ...solver.pieces.piece import Piece
from ...solver.pieces.placement import Placement
from ...solver.pieces.reach import grown, rest_weights
from ...solver.pieces.shape import Shape
from ...solver.pieces.symmetry import with_own_symmetry
from ...solver.surface.symmetry import LEAST_MATCHING
from .. import handles, mesh_bridge
from ..environment.requirements import check_requirements
from ..regions.region import shares_of
from ..settings.values import Settings
from .bones import read_bones
from .cages import read_cage
from .object_frame import placements
from .reflections import modifier_reflections


@dataclass(frozen=True, eq=False)
class ShapeRead(Shape):
    """The original shape of an object and its virtual triangulation, read once."""

    start: mesh_bridge.Start = "HERE"
    """which shape was read if the mesh was edited by hand since its last result"""


@dataclass(frozen=True, eq=False, kw_only=True)
class Member(Piece):
    """An object as a piece for the solver, free of references to Blender's data."""

    uid: int
    """``session_uid`` of the object"""
    shape: ShapeRead
    settings: Settings
    alone: Placement
    in_world: Placement | None
    """None if it cannot be solved with others"""
    weights: Mapping[str, np.ndarray]
    """(n,) of each vertex group that the map, the detail and the regions name"""

    @property
    def is_symmetric_by_itself(self) -> bool:
        """Whether its halves are kept alike although that was not asked for."""
        return self.whole.matching is not None and not any(self.settings.symmetry)

    def with_cubeness(self, cubeness: float) -> Member:
        """Return the same with another cubeness, but for its regions."""
        settings = replace(self.settings, cubeness=cubeness)
        own, *regions = self.placement.styles
        styles = (replace(own, cubeness=cubeness), *regions)
        return replace(self, settings=settings, placement=replace(self.placement, styles=styles))


T = TypeVar("T")


def assemblies(items: Sequence[T]) -> list[list[T]]:
    """Return the objects that are solved together, in the order of the first of each group.

    `items`: one for each object, with its ``settings``, and ``in_world``, which is None if it
    cannot be solved with others.
    """
    joined = [item for item in items if _is_joined(item)]
    return [
        joined if _is_joined(item) else [item]
        for item in items
        if not _is_joined(item) or item is joined[0]
    ]


def _is_joined(item: Any) -> bool:
    return item.settings.together == "SELECTION" and item.in_world is not None


def placed(members: Sequence[Member]) -> list[Member]:
    """Return the members of an assembly where they are solved: one alone, several in the world."""
    if len(members) == 1:
        alone = replace(members[0], placement=members[0].alone)
        settings = alone.settings
        if not settings.keep_symmetric:
            return [alone]
        stands = settings.floor != "OFF" and not settings.handles
        return [with_own_symmetry(alone, alone.alone.up if stands else None)]
    return [replace(one, placement=one.in_world) for one in members if one.in_world is not None]


def read_shape(obj: bpy.types.Object, start: mesh_bridge.Start = "HERE") -> ShapeRead:
    """Read the original shape of an object.

    `start`: {"HERE", "ORIGINAL", "EDITS"}, which shape is the original if the mesh was edited by
    hand since its last result. Raises CubicCraftError: the object cannot be used; the message names
    it and the remedy.
    """
    check_requirements()
    mesh_bridge.check_editable(obj)
    mesh = mesh_bridge.mesh_of(obj)
    original = mesh_bridge.original_positions(mesh, start)
    triangles = mesh_bridge.triangles(mesh, original)
    has_polygons = len(triangles) > len(mesh.polygons)
    faces = mesh_bridge.faces_of_triangles(mesh) if has_polygons else None
    return ShapeRead(original, triangles, read_cage(obj), faces, start=start)


def read_member(
    obj: bpy.types.Object,
    settings: Settings,
    known: Member | None = None,
    *,
    weights_changed: bool = False,
    rigged: bpy.types.Object | None = None,
) -> Member:
    """Read and check an object.

    `known`: Member, optional, of the same object: unchanged data is reused. The shape has not
    changed. `weights_changed`: whether the weights of vertex groups may have changed. `rigged`:
    Object, optional, the object whose visible mesh this is, in the pose that it has now. Raises
    CubicCraftError: the object or a setting cannot be used; the message names the object and the
    remedy.
    """
    begin = time.perf_counter()
    alone, in_world = placements(obj, settings, is_posed=rigged is not None)
    shape = _with_cage(known.shape, obj) if known else read_shape(obj, settings.start)
    if known is None or known.alone.shape_key != alone.shape_key:
        _check_alone(obj.name, alone, shape)
    if known is not None and known.alone.shape_key != alone.shape_key:
        known = None
    reflections = modifier_reflections(obj)
    if weights_changed:
        known = None
    V = alone.place(shape.original)
    handle_of = _handle_of(obj, settings, V, shape.triangles, known)
    weights = _weights(obj, settings, known)
    whole = _whole(obj.name, shape, reflections, settings)
    bones = _bones(obj, settings, whole, alone, shape, known, rigged)
    return Member(
        uid=obj.session_uid,
        name=obj.name,
        shape=shape,
        whole=whole,
        placement=alone,
        settings=settings,
        alone=alone,
        in_world=in_world,
        handles=settings.handles,
        handle_of=handle_of,
        rest_weights=_rest_weights(settings, V, shape.triangles, handle_of, known),
        weights=weights,
        map_weights=_map_weights(settings, weights),
        detail_weights=weights.get(settings.detail_group, 1.0),
        region_shares=shares_of(settings.regions, weights),
        bones=bones,
        seconds=time.perf_counter() - begin,
    )


def _with_cage(shape, obj):
    """Return a known shape; its modifiers and creases may have changed."""
    cage = read_cage(obj)
    is_same = shape.cage == cage
    return shape if is_same else replace(shape, cage=cage)


def _check_alone(name, placement, shape):
    """Refuse an invalid shape here, because an assembly could not name the object."""
    try:
        check_mesh(placement.place(shape.original), shape.triangles)
    except CubicCraftError as error:
        raise CubicCraftError(f'"{name}": {error}') from error


def _handle_of(obj, settings, V, F, known):
    if known and _groups(settings) == _groups(known.settings):
        return known.handle_of
    return grown(handles.handle_of(obj, settings.handles), settings.handles, V, F)


def _rest_weights(settings, V, F, handle_of, known):
    if not settings.hold_rest:
        return None
    if known and known.handle_of is handle_of and known.rest_weights is not None:
        pairs = zip(settings.handles, known.settings.handles, strict=True)
        if all(now.is_moved == before.is_moved for now, before in pairs):
            return known.rest_weights
    return rest_weights(settings.handles, handle_of, V, F)


def _groups(settings):
    return [handle.members for handle in settings.handles]


def _weights(obj, settings, known):
    regions = (region.group for region in settings.regions)
    names = [name for name in (settings.map_group, settings.detail_group, *regions) if name]
    if known and known.weights.keys() >= set(names):
        return known.weights
    return mesh_bridge.weights_of_groups(obj, names)


def _map_weights(settings, weights):
    if not settings.map_group:
        return 1.0
    found = weights[settings.map_group]
    return 1.0 - found if settings.map_invert else found


def _bones(obj, settings, whole, alone, shape, known, rigged):
    if not settings.keep_pose:
        return None
    earlier = known.bones if known and rigged is None else None
    return read_bones(obj, shape.original, whole, alone, earlier, rigged)


def _whole(name, shape, reflections, settings):
    whole = shape.whole(reflections, settings.symmetry, is_smooth=settings.refine == "AUTO")
    if whole.matching is not None and whole.matching < LEAST_MATCHING * len(shape.original):
        raise CubicCraftError(
            f'"{name}" is not symmetric: only {whole.matching:,} of its {len(shape.original):,}'
            " vertices have a mirror image about the axes of Symmetry, and would tear it apart;"
            " turn these off, or use Mesh > Symmetrize first"
        )
    return whole
