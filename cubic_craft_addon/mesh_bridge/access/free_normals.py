# SPDX-License-Identifier: GPL-3.0-or-later
"""Free custom normals, which Blender 4.5 and newer store as vectors in object space.

The older kind is stored relative to the surface and follows it by itself. A free normal stays
where it points, so it has to be turned with the surface. It belongs to a vertex, to the corner of
a face, or to a face.
"""

import bpy
import numpy as np

from .arrays import corner_vertices, read_values

_NAME = "custom_normal"
_DOMAINS = ("POINT", "CORNER", "FACE")


def read_free_normals(mesh: bpy.types.Mesh) -> np.ndarray | None:
    """Read the free normals as a (k,3) float32 array, None if there are none."""
    attribute = _find(mesh)
    return None if attribute is None else read_values(attribute.data, "vector", width=3)


def write_free_normals(mesh: bpy.types.Mesh, normals: np.ndarray) -> None:
    """Write a (k,3) float32 array to the free normals; `mark_moved` must follow."""
    attribute = _find(mesh)
    if attribute is not None and len(attribute.data) == len(normals):
        attribute.data.foreach_set("vector", np.ravel(normals))


def domain_of_free_normals(mesh: bpy.types.Mesh) -> str | None:
    """Return what the free normals belong to: "POINT", "CORNER" or "FACE"; None without them."""
    attribute = _find(mesh)
    return None if attribute is None else attribute.domain


def turned(mesh: bpy.types.Mesh, normals: np.ndarray, matrices: np.ndarray) -> np.ndarray:
    """Turn the free normals of a mesh with its vertices; that of a face by all of its corners.

    `mesh`: the mesh that they were read from. `normals`: (k,3) float32. `matrices`: (n,3,3), of
    each vertex. Returns (k,3) float32 of the same lengths; the bits of `normals` where nothing
    turns.
    """
    domain = domain_of_free_normals(mesh)
    is_turned = (matrices != np.eye(3)).any(axis=(1, 2))
    if domain != "POINT":
        corners = corner_vertices(mesh)
        matrices, is_turned = matrices[corners], is_turned[corners]
    if domain == "FACE":
        starts = read_values(mesh.polygons, "loop_start", np.int32)
        if len(starts):
            matrices = np.add.reduceat(matrices, starts)
            is_turned = np.logical_or.reduceat(is_turned, starts)
    vectors = np.einsum("kij,kj->ki", matrices, normals.astype(np.float64))
    before, after = (np.linalg.norm(n, axis=1, keepdims=True) for n in (normals, vectors))
    is_turned &= (after > 0.0).ravel()
    scale = before / np.where(after > 0.0, after, 1.0)
    return np.where(is_turned[:, None], (scale * vectors).astype(np.float32), normals)


def _find(mesh: bpy.types.Mesh) -> bpy.types.FloatVectorAttribute | None:
    for attribute in mesh.attributes:
        is_free = isinstance(attribute, bpy.types.FloatVectorAttribute)
        if is_free and attribute.name == _NAME and attribute.domain in _DOMAINS:
            return attribute
    return None
