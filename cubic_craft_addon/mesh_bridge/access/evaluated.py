# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface of an object as it is seen, with its modifiers; nothing is changed."""

import contextlib

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .arrays import corner_vertices, read_values


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
