# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangles that a mesh is solved on; the mesh itself keeps its faces."""

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
