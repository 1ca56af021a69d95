# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces that are selected in Edit Mode, and which of a mesh can be."""

import bmesh
import bpy
import numpy as np

from .arrays import read_values


def read_selected_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Return the normals of the selected faces of a mesh in Edit Mode, as they are now.

    Returns (n,3), object space, each as long as the area of its face.
    """
    faces = bmesh.from_edit_mesh(mesh).faces
    found = [(face.normal * face.calc_area())[:] for face in faces if face.select]
    return np.array(found, dtype=np.float64).reshape(-1, 3)


def not_hidden(mesh: bpy.types.Mesh, faces: np.ndarray) -> np.ndarray:
    """Return those of some faces, by their numbers, that can be seen in Edit Mode."""
    return faces[~read_values(mesh.polygons, "hide", bool)[faces]]


def select_faces(mesh: bpy.types.Mesh, faces: np.ndarray) -> None:
    """Select faces of a mesh in Edit Mode, by their numbers, besides what is selected."""
    edited = bmesh.from_edit_mesh(mesh)
    edited.faces.ensure_lookup_table()
    for number in faces.tolist():
        edited.faces[number].select_set(True)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
