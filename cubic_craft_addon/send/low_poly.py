# SPDX-License-Identifier: GPL-3.0-or-later
"""The low-poly mesh that a normal map is for: its triangles, its UV map and its hard edges."""

import math
from typing import Any

import bpy
import numpy as np

from ...solver import CubicCraftError
from ..mesh_bridge import read_values
from .bake import Studio
from .split import OldSurface, split_for_keys
from .uv_overlap import overlap

_OVERLAP = 0.01  # of what is covered: as much as decimation may leave along seams
_INSIDE = 1e-4  # how far a UV map may reach out of the unit square
_HARD = math.radians(30)  # edges between UV islands with larger angles are hard
_HARD_INSIDE = math.radians(50)  # those inside of islands
_UNWRAPPED = math.radians(60)  # largest angle between faces and what they are projected to
_MARGIN = 8  # texels between two islands
_LARGEST_MARGIN = 0.02  # of the width of the map
_FOR_KEYS = 3
"""one of so many triangles is kept for shape keys"""
_FULL = 0.9
"""of the triangles: if fewer are used, decimation may have what shape keys have left"""
_ENDS = np.array([0, 1, 2, 0])  # corners of a triangle around its edges


def decimated(
    studio: Studio,
    obj: bpy.types.Object,
    triangles: int,
    surface: OldSurface,
) -> bpy.types.Mesh:
    """Return a new mesh of triangles, about as many as given or fewer.

    If the old surface has shape keys, some are kept for where these bend it.

    `obj`: an object in the studio.
    """
    if not surface.offsets:
        return _decimated(studio, obj, triangles)
    kept = triangles // _FOR_KEYS
    mesh = _decimated(studio, obj, triangles - kept)
    used = split_for_keys(mesh, surface, triangles - len(mesh.polygons))
    if len(mesh.polygons) < _FULL * triangles and used < kept:
        bpy.data.meshes.remove(mesh)
        mesh = _decimated(studio, obj, triangles - used)
        split_for_keys(mesh, surface, triangles - len(mesh.polygons))
    return mesh


def _decimated(studio: Studio, obj: bpy.types.Object, triangles: int) -> bpy.types.Mesh:
    present = studio.evaluated_mesh(obj)
    count = len(present.loops) - 2 * len(present.polygons)
    bpy.data.meshes.remove(present)
    if count > triangles:
        decimate: Any = obj.modifiers.new("Low", "DECIMATE")
        decimate.ratio = triangles / count
        decimate.use_collapse_triangulate = True
    obj.modifiers.new("Triangles", "TRIANGULATE")
    made = studio.evaluated_mesh(obj)
    obj.modifiers.clear()
    return made


def forget_normals(studio: Studio, obj: bpy.types.Object) -> None:
    """Remove custom normals, which fit another shape."""
    mesh: Any = obj.data
    if mesh.has_custom_normals:
        with studio.context(obj):
            bpy.ops.mesh.customdata_custom_splitnormals_clear()


def choose_uv(studio: Studio, obj: bpy.types.Object, resolution: int, name: str) -> str:
    """Return the UV map to bake to: the active one if no faces overlap in it, otherwise a new one.

    `obj`: an object in the studio, whose mesh has triangles only. `resolution`: of the image;
    islands stay some of its texels apart. `name`: what the artist calls the object. Returns the
    name of the UV map, which is active. The one that is rendered stays the same. Raises
    CubicCraftError: there is no room for one more.
    """
    mesh: Any = obj.data
    active = mesh.uv_layers.active
    if active is not None and _is_usable(mesh):
        return active.name
    layer = mesh.uv_layers.new(name="Normal Map" if active is not None else "UVMap")
    if layer is None:
        raise CubicCraftError(f'"{name}" has too many UV maps for one more: remove one first')
    uv_map = layer.name
    mesh.uv_layers.active = layer
    _unwrap(studio, obj, min(_MARGIN / resolution, _LARGEST_MARGIN))
    return uv_map


def uv_of_triangles(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    """Return the UVs (m,3,2) of a mesh of triangles."""
    return read_values(mesh.uv_layers[name].uv, "vector", width=2).reshape(-1, 3, 2)


def set_hard_edges(mesh: bpy.types.Mesh, name: str) -> None:
    """Shade smooth, except for edges at which sides meet.

    Over soft edges the map must take back a bend of the normals, at which its eight bits show. Hard
    edges between islands of the UV map are free. Those inside may show as lines, because the map
    has no room between the two sides, so only clear edges are hard there.

    `mesh`: a mesh of triangles. `name`: of the UV map.
    """
    edge_of = read_values(mesh.loops, "edge_index", np.int32)
    vertices = read_values(mesh.loops, "vertex_index", np.int32).reshape(-1, 3)
    normals = read_values(mesh.polygons, "normal", width=3)
    uv = uv_of_triangles(mesh, name)
    ends = np.stack([vertices[:, _ENDS[:-1]], vertices[:, _ENDS[1:]]], axis=-1).reshape(-1, 2)
    sides = np.stack([uv[:, _ENDS[:-1]], uv[:, _ENDS[1:]]], axis=2).reshape(-1, 2, 2)
    turned = ends[:, 0] > ends[:, 1]
    sides[turned] = sides[turned, ::-1]
    order = np.argsort(edge_of, kind="stable")
    first, second = order[:-1], order[1:]
    is_pair = edge_of[first] == edge_of[second]
    first, second = first[is_pair], second[is_pair]
    is_border = (np.abs(sides[first] - sides[second]) > 1e-5).any(axis=(1, 2))
    cosines = np.einsum("ij,ij->i", normals[first // 3], normals[second // 3])
    is_hard = np.zeros(len(mesh.edges), bool)
    limits = np.where(is_border, math.cos(_HARD), math.cos(_HARD_INSIDE))
    is_hard[edge_of[first[cosines < limits]]] = True
    mesh.polygons.foreach_set("use_smooth", np.ones(len(normals), bool))
    mesh.edges.foreach_set("use_edge_sharp", is_hard)
    mesh.update()


def _is_usable(mesh: Any) -> bool:
    uv = uv_of_triangles(mesh, mesh.uv_layers.active.name)
    is_in_image = bool((uv > -_INSIDE).all() and (uv < 1 + _INSIDE).all())
    return is_in_image and overlap(uv) < _OVERLAP


def _unwrap(studio: Studio, obj: bpy.types.Object, margin: float) -> None:
    with studio.context(obj):
        bpy.ops.object.mode_set(mode="EDIT")
    try:
        with studio.context(obj, edit_object=obj):
            bpy.ops.mesh.reveal()
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.uv.smart_project(
                angle_limit=_UNWRAPPED, island_margin=margin, margin_method="FRACTION"
            )
    finally:
        with studio.context(obj):
            bpy.ops.object.mode_set(mode="OBJECT")
