# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls whose cubic shape has six clear sides, and how much of them is planar."""

import bpy
import numpy as np
from rich_mesh import position_of

PLANAR = 0.75
"""share of a flattened ball; the rest are its rounded edges"""
WIDE = {"angle": 0.7, "tolerance": 0.05}


def add_ball(name="Ball", **where):
    """Add a sphere of quads with UVs, whose cubic shape has six clear sides."""
    bpy.ops.mesh.primitive_cube_add(**where)
    obj = bpy.context.object
    obj.name = name
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=11)
    bpy.ops.transform.tosphere(value=1.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


def flatten(**options):
    return bpy.ops.cubic_craft.flatten(**options)


def world(obj, positions=None):
    """Return positions, those of the mesh unless others are given, in the world."""
    points = position_of(obj.data) if positions is None else positions
    matrix = np.array(obj.matrix_world)
    return points.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def planar_share(obj, positions=None, axes=None):
    """Return the share of the surface that faces along an axis of the world, up to rounding."""
    V = world(obj, positions)
    obj.data.calc_loop_triangles()
    F = np.array([triangle.vertices for triangle in obj.data.loop_triangles])
    N = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    areas = np.linalg.norm(N, axis=1)
    is_planar = np.abs(N @ (np.eye(3) if axes is None else axes)).max(axis=1) > areas * (1 - 1e-9)
    return areas[is_planar].sum() / areas.sum()
