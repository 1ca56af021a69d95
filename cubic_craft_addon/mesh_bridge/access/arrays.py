# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates of a mesh to float32 arrays and back, bit for bit.

Blender stores coordinates as float32, and ``foreach_get`` / ``foreach_set`` take the fast path
(one memory copy) only with a flat float32 buffer.
"""

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .sharp_edges import follow_shape
from .values import read_values


def read_position(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the ``position`` attribute of a mesh.

    Returns (n,3) float32, object space. Raises CubicCraftError: the mesh is in Edit Mode, where the
    attribute does not exist.
    """
    if mesh.is_editmode:
        raise CubicCraftError(f'Mesh "{mesh.name}" is in Edit Mode: go back to Object Mode first')
    if not len(mesh.vertices):  # it may have no such attribute
        return np.empty((0, 3), np.float32)
    return read_values(_position_of(mesh).data, "vector", width=3)


def write_position(mesh: bpy.types.Mesh, positions: np.ndarray) -> None:
    """Write an (n,3) float32 array to the ``position`` attribute; `mark_moved` must follow."""
    if len(positions):  # a mesh without vertices may have no such attribute
        _position_of(mesh).data.foreach_set("vector", np.ravel(positions))


def read_key(mesh: bpy.types.Mesh, key: bpy.types.ShapeKey) -> np.ndarray:
    """Read the points of a shape key of a mesh.

    Returns (n,3) float32, object space. Raises CubicCraftError: the key does not fit the mesh,
    which scripts may cause.
    """
    check_fits(mesh, key)
    return read_values(key.points, "co", width=3)


def check_fits(mesh: bpy.types.Mesh, key: bpy.types.ShapeKey) -> None:
    """Check that a shape key has a point for each vertex of its mesh.

    Raises CubicCraftError: it does not fit, which scripts may cause.
    """
    if len(key.points) != len(mesh.vertices):
        raise CubicCraftError(
            f'Shape key "{key.name}" of mesh "{mesh.name}" has {len(key.points)} points for '
            f"{len(mesh.vertices)} vertices: delete the shape key first"
        )


def write_key(key: bpy.types.ShapeKey, positions: np.ndarray) -> None:
    """Write an (n,3) float32 array to the points of a shape key; `mark_moved` must follow."""
    key.points.foreach_set("co", np.ravel(positions))


def mark_moved(mesh: bpy.types.Mesh) -> None:
    """Notify Blender that positions of the mesh have changed.

    ``foreach_set`` notifies nobody, and ``mesh.update()`` would keep the cached triangulation and
    bounding box of the old shape. Setting a single coordinate, even to the same value, drops all
    caches, tags the mesh for evaluation and redraws. Sharp edges that follow the shape do so now.
    """
    if mesh.vertices:
        first = mesh.vertices[0]
        first.co = first.co
        follow_shape(mesh)


def loose_vertices(mesh: bpy.types.Mesh) -> np.ndarray:
    """Find the vertices that belong to no face.

    Returns (n,) bool.
    """
    loose = np.ones(len(mesh.vertices), bool)
    loose[corner_vertices(mesh)] = False
    return loose


def corner_vertices(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the vertex of every face corner, in the order of the faces, as int32."""
    attribute = mesh.attributes.get(".corner_vert")
    if isinstance(attribute, bpy.types.IntAttribute):
        return read_values(attribute.data, "value", np.int32)  # a hundred times as fast
    return read_values(mesh.loops, "vertex_index", np.int32)


def _position_of(mesh: bpy.types.Mesh) -> bpy.types.FloatVectorAttribute:
    attribute = mesh.attributes["position"]
    assert isinstance(attribute, bpy.types.FloatVectorAttribute)
    return attribute
