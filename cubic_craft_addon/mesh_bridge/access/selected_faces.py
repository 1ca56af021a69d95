# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces that are selected in Edit Mode; nothing is changed."""

import bmesh
import bpy
import numpy as np


def read_selected_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Return the normals of the selected faces of a mesh in Edit Mode, as they are now.

    Returns
    -------
    (n,3) numpy float64 array, object space
        Each as long as the area of its face.
    """
    faces = bmesh.from_edit_mesh(mesh).faces
    found = [(face.normal * face.calc_area())[:] for face in faces if face.select]
    return np.array(found, dtype=np.float64).reshape(-1, 3)
