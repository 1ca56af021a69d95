# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of an object whose planar facets are single faces."""

from collections.abc import Callable

import bmesh
import bpy
import numpy as np

from ..access.checks import mesh_of
from ..access.copies import remove_copy
from .new_object import link_beside, select_instead
from .plain_copy import plain_copy

_ANGLE = 1e-3  # radians; small triangles of a facet are off by the rounding of their corners


def write_ngons(
    obj: bpy.types.Object,
    positions: np.ndarray,
    facet_of: np.ndarray,
    finish: Callable[[bpy.types.Object], None] = lambda new: None,
) -> bpy.types.Object:
    """Copy an object in another shape, and dissolve the faces of each facet.

    The copy is named "<name> Facets", lies in the collections of the source, and takes its place
    in the selection, as with `write_new_object`. It keeps UVs, materials, vertex groups and
    modifiers, but no shape keys and no original. Edges stay where UVs or materials change, or that
    are seams or sharp.

    Parameters
    ----------
    obj : an object with a mesh, not in Edit Mode
    positions : (n,3) numpy float32 array, object space, in which the facets are planar
    facet_of : (m,) numpy int array, the facet of each of its `triangles`, or -1
    finish : called last, with the new object

    Returns
    -------
    the new object

    Raises
    ------
    CubicCraftError
        A mesh that cannot be written. After any exception, also of `finish`, there is no new
        object, and the same objects are selected as before.
    """
    mesh = mesh_of(obj)
    active, is_selected = bpy.context.view_layer.objects.active, obj.select_get()
    new = plain_copy(obj, positions)
    try:
        new_mesh = mesh_of(new)
        _dissolve(new_mesh, _facet_of_faces(new_mesh, facet_of))
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


def _facet_of_faces(mesh: bpy.types.Mesh, facet_of: np.ndarray) -> np.ndarray:
    """Return the facet of each face whose triangles all lie in the same one, or -1."""
    starts = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_start", starts)
    first = starts - 2 * np.arange(len(starts))  # a face of k corners has k - 2 triangles
    lowest = np.minimum.reduceat(facet_of, first)
    return np.where(lowest == np.maximum.reduceat(facet_of, first), lowest, -1)


def _dissolve(mesh: bpy.types.Mesh, facet_of: np.ndarray) -> None:
    """Dissolve the edges inside facets, and the vertices on straight edges between them."""
    edited = bmesh.new()
    try:
        edited.from_mesh(mesh)
        edited.faces.ensure_lookup_table()
        facets = facet_of.tolist()
        edges = [edge for edge in edited.edges if _is_inside(edge, facets)]
        verts = [
            vert
            for vert in edited.verts
            if any(facets[face.index] >= 0 for face in vert.link_faces)
        ]
        bmesh.ops.dissolve_limit(
            edited,
            angle_limit=_ANGLE,
            use_dissolve_boundaries=False,
            verts=verts,
            edges=edges,
            delimit={"UV", "MATERIAL", "SEAM", "SHARP"},
        )
        edited.to_mesh(mesh)
    finally:
        edited.free()
    mesh.update()


def _is_inside(edge: bmesh.types.BMEdge, facets: list[int]) -> bool:
    """Return whether all faces at an edge lie in the same facet."""
    found = {facets[face.index] for face in edge.link_faces}
    return len(found) == 1 and -1 not in found
