# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangles that a mesh is solved on, its selected faces, and the surface that is seen."""

import contextlib

import bmesh
import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .arrays import corner_vertices, read_values, write_position


def triangles(mesh: bpy.types.Mesh, positions: np.ndarray) -> np.ndarray:
    """Triangulate the faces of a mesh as Blender does for a given shape.

    Where a face with more than three corners is cut depends on the shape. Cubify must always cut
    the original, however the mesh looks now.

    `mesh`: a mesh in Object Mode. `positions`: (n,3) float32, the original positions. Returns (m,3)
    int32; vertices in no face do not occur. Raises CubicCraftError: a face refers to a vertex that
    does not exist. Some importers create such faces, and triangulating them would read memory
    outside the mesh.
    """
    corners = corner_vertices(mesh)
    wrong = corners[(corners < 0) | (corners >= len(positions))]
    if len(wrong):
        raise CubicCraftError(
            f'A face of mesh "{mesh.name}" refers to vertex {wrong[0]}, but there are only'
            f" {len(positions)}: repair it (mesh.validate() in the Python console) or import it"
            " again"
        )
    if len(corners) == 3 * len(mesh.polygons):
        return corners.reshape(-1, 3)
    starts = read_values(mesh.polygons, "loop_start", np.int32)
    # A bare mesh of its own also has no cached normals, which can change how faces are cut.
    bare = bpy.data.meshes.new("cubic_craft_triangulation")
    try:
        bare.vertices.add(len(positions))
        write_position(bare, positions)
        bare.loops.add(len(corners))
        bare.loops.foreach_set("vertex_index", corners)
        bare.polygons.add(len(starts))
        bare.polygons.foreach_set("loop_start", starts)
        bare.calc_loop_triangles()
        return read_values(bare.loop_triangles, "vertices", np.int32, 3)
    finally:
        bpy.data.meshes.remove(bare)


def faces_of_triangles(mesh: bpy.types.Mesh) -> np.ndarray:
    """Return the face (m,) that each of the `triangles` is a part of, whatever the shape."""
    sizes = read_values(mesh.polygons, "loop_total", np.int32)
    return np.repeat(np.arange(len(sizes)), np.maximum(sizes - 2, 0))


def read_selected_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Return the normals of the selected faces of a mesh in Edit Mode, as they are now.

    Returns (n,3), object space, each as long as the area of its face.
    """
    faces = bmesh.from_edit_mesh(mesh).faces
    found = [(face.normal * face.calc_area())[:] for face in faces if face.select]
    return np.array(found, dtype=np.float64).reshape(-1, 3)


def read_evaluated_points(obj: bpy.types.Object) -> tuple[np.ndarray, int]:
    """Read only the positions.

    Returns `points`: (n,3) float32, object space; `corners`: int, number of corners of all faces.
    Raises CubicCraftError: it has no surface.
    """
    with _evaluated_mesh(obj) as mesh:
        return read_values(mesh.vertices, "co", width=3), len(mesh.loops)


def read_evaluated(obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Read the surface of an object of any kind that has one.

    Returns `points`: (n,3) float32, object space; `triangles`: (m,3) int32. Raises CubicCraftError:
    it has no surface.
    """
    with _evaluated_mesh(obj) as mesh:
        points = read_values(mesh.vertices, "co", width=3)
        if len(mesh.loops) == 3 * len(mesh.polygons):
            return points, corner_vertices(mesh).reshape(-1, 3)  # much faster
        mesh.calc_loop_triangles()
        return points, read_values(mesh.loop_triangles, "vertices", np.int32, 3)


@contextlib.contextmanager
def _evaluated_mesh(obj):
    try:
        evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        mesh = evaluated.to_mesh()
    except RuntimeError as error:
        raise CubicCraftError(f'"{obj.name}" has no surface; pick another object') from error
    assert mesh is not None
    try:
        yield mesh
    finally:
        evaluated.to_mesh_clear()
