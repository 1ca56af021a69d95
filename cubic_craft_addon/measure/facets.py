# SPDX-License-Identifier: GPL-3.0-or-later
"""The planar facets of a cubic shape, found and made flat; this changes nothing in Blender."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import bpy
import numpy as np

from ... import solver
from ...solver import CubicCraftError
from ...solver.pieces.placement import Placement
from ...solver.styles.style import Style
from .. import mesh_bridge
from ..environment.requirements import check_requirements
from ..mesh_bridge import LastRun, Polygons
from ..read.object_frame import placement_alone
from ..read.reflections import modifier_reflections
from ..regions.region import region_shares
from ..settings.properties import settings_of
from ..settings.values import Settings

_LEAST_SHARE = 0.25
"""of a region: a triangle with less does not face its sides"""
_IN_PLANE = 1e-6  # of the largest extent: vertices closer to a mirror than this lie in it
_OF_THE_RUN = ("orientation", "space", "form", "form_sides", "form_weights", "form_directions")
"""settings that a result has been made with, whatever the panel shows now"""


def form_directions(style: Style) -> np.ndarray:
    """Return the outward unit normals (k,3) of the sides of the form, where it is solved."""
    axes = np.asarray(style.orientation)  # the rows of Q, which maps into the frame of the form
    if not style.forms:
        return np.concatenate([axes, -axes]) + 0.0
    return style.forms[0].normals @ axes


def directions_at(
    placement: Placement, triangles: np.ndarray, shares: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray | None]:
    """Return the directions of the form and of all regions, and which count for each triangle.

    `triangles`: (m,3) int. `shares`: (n,1+r), from `region_shares`, or None without regions.
    Returns `directions`: (k,3), as of `form_directions`; `counts`: (m,k) bool, or None if all count
    everywhere.
    """
    if shares is None:
        return form_directions(placement.style), None
    found = [form_directions(style) for style in placement.styles]
    part = np.repeat(np.arange(len(found)), [len(some) for some in found])
    is_there = shares[triangles].mean(axis=1) >= _LEAST_SHARE
    return np.concatenate(found), is_there[:, part]


@dataclass(frozen=True)
class Facets:
    """A flattened result that has not been written yet."""

    positions: np.ndarray
    """(n,3) float32, object space; vertices that do not move keep their bits"""
    count: int
    """number of planar facets"""
    moved: int
    """number of vertices that move"""
    largest_move: float
    """largest distance that one moves, as it is seen: with the object's scale"""
    polygons: Polygons | None
    """the whole shape as few polygons, if asked for"""


def flat_facets(
    obj: bpy.types.Object, angle: float, tolerance: float, *, with_polygons: bool = False
) -> Facets:
    """Flatten the sides of a result.

    `angle`: largest angle between a side and the direction that it should face, in radians.
    `tolerance`: largest distance that a vertex may be moved by, relative to the largest extent.
    `with_polygons`: also find the polygons of a low-poly shape. Raises CubicCraftError: the object
    has no result, or none with sides that can be flattened.
    """
    check_requirements()
    mesh_bridge.check_editable(obj)
    run = mesh_bridge.last_run(obj)
    if run is None:
        raise CubicCraftError(f'"{obj.name}" has no result to flatten: cubify it first')
    present = mesh_bridge.result_positions(obj)
    settings = settings_of_run(obj, run)
    placement = placement_alone(obj, settings)
    V = placement.place(present)
    triangles = mesh_bridge.triangles(mesh_bridge.mesh_of(obj), present)
    directions, counts = directions_at(placement, triangles, region_shares(obj, settings.regions))
    distance = tolerance * float(np.ptp(V, axis=0).max())
    walls = list(_walls(obj, placement, present))
    flat = solver.flatten_facets(V, triangles, directions, angle, distance, walls, counts)
    if not flat.count:
        raise CubicCraftError(
            f'"{obj.name}" has no sides that can be flattened: raise Angle or Tolerance, or cubify'
            " it with more Cubeness"
        )
    is_moved = (flat.positions != V).any(axis=1)
    back = placement.read_back(flat.positions).astype(np.float32)
    positions = np.where(is_moved[:, None], back, present)
    polygons = None
    if with_polygons:
        surface = Surface(mesh_bridge.mesh_of(obj), present, placement, directions, walls, counts)
        polygons = surface.polygons(tolerance)
    return Facets(positions, flat.count, flat.moved, flat.largest_move, polygons)


@dataclass(frozen=True)
class Surface:
    """A mesh in the shape of a result, with the sides that it should have."""

    mesh: bpy.types.Mesh
    positions: np.ndarray
    """(n,3) float32, object space"""
    placement: Placement
    directions: np.ndarray
    """(k,3), of the sides"""
    walls: Sequence[tuple[np.ndarray, np.ndarray]] = ()
    """as of `flatten_facets`"""
    counts: np.ndarray | None = None
    """(m,k) bool, as of `flatten_facets`"""

    def polygons(self, tolerance: float) -> Polygons:
        """Return the whole shape as few polygons; `tolerance` is as of `flat_facets`."""
        V = self.placement.place(self.positions)
        triangles = mesh_bridge.triangles(self.mesh, self.positions)
        charts, cuts = mesh_bridge.charts(self.mesh, self.positions)
        distance = tolerance * float(np.ptp(V, axis=0).max())
        made = solver.low_poly(
            V, triangles, self.directions, distance, self.walls, self.counts, charts, cuts
        )
        is_moved = (made.positions != V).any(axis=1)
        back = self.placement.read_back(made.positions).astype(np.float32)
        back = np.where(is_moved[:, None], back, self.positions)
        return Polygons(back, made.polygons, made.part_of, made.parts, triangles, made.places)


def settings_of_run(obj: bpy.types.Object, run: LastRun) -> Settings:
    """Return the settings of an object, with the sides that its result has been made with."""
    noted = {name: run.settings.get(name) for name in _OF_THE_RUN}
    values = {
        name: tuple(value) if isinstance(value, list) else value
        for name, value in noted.items()
        if value is not None
    }
    return replace(settings_of(obj, handles=()), **values)


def _walls(
    obj: bpy.types.Object, placement: Placement, points: np.ndarray
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield the vertices in the plane of each mirror of the object's modifier, and its normal.

    They stay there, or the seam between the halves would open.
    """
    size = float(np.ptp(points, axis=0).max())
    for reflection in modifier_reflections(obj):
        is_inside = reflection.is_in_plane(points.astype(np.float64), _IN_PLANE * size)
        yield is_inside, np.linalg.inv(placement.linear).T @ reflection.normal
