# SPDX-License-Identifier: GPL-3.0-or-later
"""What a form is made from: the meshes of a file of its own."""

from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np

from ...mesh_bridge import read_values
from .load_meshes import empty_blender, load


class FormMesh(NamedTuple):
    """All meshes of a file as one, in the axes of the scene, about its origin."""

    points: np.ndarray
    """(n,3)"""
    triangles: np.ndarray
    """(m,3) int"""


def read_form(path: Path) -> FormMesh:
    """Read the meshes of a file; Blender is empty afterwards.

    Raises InputError: the file cannot be read, or holds no mesh.
    """
    points, triangles, count = [], [], 0
    for obj in load(path, None).objects:
        mesh = obj.data
        mesh.calc_loop_triangles()
        matrix = np.array(obj.matrix_world)
        own = read_values(mesh.vertices, "co", width=3).astype(np.float64)
        points.append(own @ matrix[:3, :3].T + matrix[:3, 3])
        corners = read_values(mesh.loop_triangles, "vertices", np.int32, width=3)
        triangles.append(corners[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else corners)
        triangles[-1] = triangles[-1] + count
        count += len(own)
    empty_blender()
    return FormMesh(np.concatenate(points), np.concatenate(triangles))


def make_form(form: FormMesh) -> bpy.types.Object:
    """Make an object that is in no scene, so that nothing of it is written."""
    mesh = bpy.data.meshes.new("Form")
    mesh.from_pydata(form.points.tolist(), [], form.triangles.tolist())
    return bpy.data.objects.new("Form", mesh)
