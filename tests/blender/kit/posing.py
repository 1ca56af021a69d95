# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh with handles, and what the handles should do to it."""

import bpy
import numpy as np
from rich_mesh import position_of
from scene import add_triangles, select

LEFT, RIGHT = "Left", "Right"
"""vertex groups of `add_posable`"""
IDENTITY = tuple(np.eye(4).ravel())
"""the matrix of a handle at rest"""


def add_posable(name="Body", **where):
    """Add a shape with two vertex groups at its ends; return it and the vertices of each."""
    obj = add_triangles()
    obj.name = name
    for attribute, value in where.items():
        setattr(obj, attribute, value)
    bpy.context.view_layer.update()
    x = position_of(obj.data)[:, 0]
    ends = {LEFT: np.flatnonzero(x < -0.7), RIGHT: np.flatnonzero(x > 0.7)}
    for group, vertices in ends.items():
        obj.vertex_groups.new(name=group).add(vertices.tolist(), 1.0, "REPLACE")
    return obj, ends[LEFT], ends[RIGHT]


def pin(obj, group):
    """Add a pinned handle as an artist does."""
    select(obj)
    assert bpy.ops.cubic_craft.handle_add(group=group) == {"FINISHED"}
    return obj.cubic_craft.handles[-1]


def follow(obj, group):
    """Add a handle that follows an empty as an artist does; return the empty."""
    pin(obj, group)
    assert bpy.ops.cubic_craft.handle_follow() == {"FINISHED"}
    return bpy.context.object


def pose(obj, left=LEFT, right=RIGHT):
    """Pin the left end, let the right one follow an empty, move and turn it; return the empty."""
    pin(obj, left)
    empty = follow(obj, right)
    empty.location += empty.location.to_3d() * 0.5
    empty.rotation_euler = (0.3, 0.4, -0.2)
    bpy.context.view_layer.update()
    return empty


def mapped(points, matrix):
    """Return float32 points where a handle with this matrix (16 numbers) takes them."""
    matrix = np.reshape(matrix, (4, 4))
    return (points.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]).astype(np.float32)
