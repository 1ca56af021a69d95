# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of an object as few planar polygons."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import bmesh
import bpy
import numpy as np

from ..access.any_mode import remove_copy
from ..access.arrays import write_position
from ..access.checks import mesh_of
from ..access.triangulation import faces_of_triangles
from .new_object import link_beside, plain_copy, select_instead
from .results import result_positions
from .transferred_keys import key_offsets, transfer_keys

_BENT = math.radians(10.0)
"""edges between faces at a larger angle are those between sides"""
_LAYERS = {"CREASES": "crease_edge", "BEVEL": "bevel_weight_edge"}


@dataclass(frozen=True)
class Polygons:
    """Few polygons that take the place of the faces of a mesh."""

    positions: np.ndarray
    """(n,3) float32, object space"""
    loops: list[list[int]]
    """the vertices of each"""
    part_of: list[int]
    """the part of the surface that each is of"""
    parts: np.ndarray
    """(m,) the same of each triangle of the mesh"""
    triangles: np.ndarray
    """(m,3) these"""
    places: np.ndarray
    """(n,) of vertices at the same place, the first, which stands for all"""


def write_ngons(
    obj: bpy.types.Object,
    polygons: Polygons,
    edges: str = "NONE",
    finish: Callable[[bpy.types.Object], None] = lambda new: None,
) -> bpy.types.Object:
    """Copy an object as few polygons, with flat shading.

    The copy is named "<name> Facets", lies in the collections of the source, and takes its place
    in the selection, as with `write_new_object`. It keeps UVs, materials, vertex groups, modifiers
    and shape keys, but no original.

    `obj`: an object with a result, not in Edit Mode. `edges`: "NONE", "CREASES" or "BEVEL": the
    weights of edges between sides. `finish`: called last, with the new object. Returns the new
    object. Raises CubicCraftError: a mesh that cannot be written. After any exception, also of
    `finish`, there is no new object, and the same objects are selected as before.
    """
    mesh = mesh_of(obj)
    active, is_selected = bpy.context.view_layer.objects.active, obj.select_get()
    new = plain_copy(obj, polygons.positions)
    try:
        new_mesh = mesh_of(new)
        rebuild(new_mesh, polygons, edges)
        surface = result_positions(obj), polygons.triangles
        transfer_keys(mesh, new, *surface, key_offsets(mesh))
        new_mesh.name, new.name = f"{mesh.name} Facets", f"{obj.name} Facets"
        link_beside(obj, new)
        select_instead(obj, new)
        finish(new)
    except BaseException:
        remove_copy(new)
        if is_selected:
            obj.select_set(True)
        bpy.context.view_layer.objects.active = active
        raise
    return new


def rebuild(mesh: bpy.types.Mesh, polygons: Polygons, edges: str = "NONE") -> None:
    """Put the polygons in place of all faces; corners keep the data of those they come from.

    `mesh`: that they are of, without shape keys. `edges`: as of `write_ngons`.
    """
    write_position(mesh, polygons.positions)
    if "custom_normal" in mesh.attributes:  # of the smooth shape
        mesh.attributes.remove(mesh.attributes["custom_normal"])
    face_of = faces_of_triangles(mesh).tolist()
    source = _Sources(polygons, face_of)
    edited = bmesh.new()
    try:
        edited.from_mesh(mesh)
        edited.faces.ensure_lookup_table()
        edited.verts.ensure_lookup_table()
        old = list(edited.faces)
        marks = _marks(edited, dict(zip(face_of, polygons.parts.tolist(), strict=True)))
        made = {}
        for loop, part in zip(polygons.loops, polygons.part_of, strict=True):
            verts = [edited.verts[v] for v in loop]
            face = edited.faces.get(verts)
            if face is None:
                face = edited.faces.new(verts, old[source.of(part, loop[0])[0]])
            for corner in face.loops:
                number, vertex = source.of(part, corner.vert.index)
                corner.copy_from(next(c for c in old[number].loops if c.vert.index == vertex))
            face.smooth = False
            made[face] = part
        bmesh.ops.delete(edited, geom=[f for f in old if f not in made], context="FACES")
        _mark(edited, made, marks, edges)
        edited.to_mesh(mesh)
    finally:
        edited.free()
    mesh.update()


class _Sources:
    """The corners of faces that those of polygons come from."""

    def __init__(self, polygons: Polygons, face_of: list[int]):
        self._positions, self._parts = polygons.positions, polygons.parts
        self._triangles = polygons.triangles
        self._face_of = np.asarray(face_of)
        self._found: dict[Any, tuple[int, int]] = {
            (part, polygons.places[vertex]): (face, vertex)
            for part, face, corners in zip(
                polygons.parts.tolist(), face_of, polygons.triangles.tolist(), strict=True
            )
            for vertex in corners
        }

    def of(self, part: int, vertex: int) -> tuple[int, int]:
        """Return a face of a part and its vertex at a place, or else the nearest one of the part.

        Some corners lie beyond the border of their part, where planes meet.
        """
        found = self._found.get((part, vertex))
        if found is None:
            rows = np.flatnonzero(self._parts == part)
            corners = self._triangles[rows]
            gaps = np.linalg.norm(self._positions[corners] - self._positions[vertex], axis=2)
            row, corner = divmod(int(gaps.argmin()), 3)
            found = int(self._face_of[rows[row]]), int(corners[row, corner])
            self._found[part, vertex] = found
        return found


def _marks(edited: bmesh.types.BMesh, part_of: dict[int, int]) -> dict[tuple[int, int], np.ndarray]:
    """Return, by pairs of parts, the number of edges between them, of seams and of sharp ones."""
    found: dict[tuple[int, int], np.ndarray] = {}
    for edge in edited.edges:
        pair = tuple(sorted(part_of[face.index] for face in edge.link_faces))
        if len(pair) == 2 and pair[0] != pair[1]:
            count = found.setdefault(pair, np.zeros(3, int))
            count += (1, edge.seam, not edge.smooth)
    return found


def _mark(edited, made, marks, edges) -> None:
    """Mark edges as most of those were that they come from, and weigh those between sides."""
    layer = None
    if edges in _LAYERS:
        layers = edited.edges.layers.float
        layer = layers.get(_LAYERS[edges]) or layers.new(_LAYERS[edges])
    for edge in edited.edges:
        pair = tuple(sorted(made[face] for face in edge.link_faces if face in made))
        if pair in marks:
            count, seams, sharp = marks[pair]
            edge.seam, edge.smooth = bool(2 * seams > count), not 2 * sharp > count
        if layer is not None:
            is_bent = len(edge.link_faces) == 2 and edge.calc_face_angle(0.0) > _BENT
            edge[layer] = 1.0 if is_bent else 0.0
