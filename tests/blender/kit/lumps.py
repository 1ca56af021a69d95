# SPDX-License-Identifier: GPL-3.0-or-later
"""A shape whose halves are mirror images, and the vertices that are opposite each other."""

import bpy
import numpy as np
from rich_mesh import position_of, set_position

FLIP_X = np.array([-1.0, 1.0, 1.0], np.float32)


def add_lump(name="Lump"):
    """Add a shape that is symmetric about X, exactly, and about nothing else."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24)
    obj = bpy.context.object
    obj.name = name
    V = position_of(obj.data).astype(np.float64)
    V *= 1 + 0.25 * np.cos(4 * V[:, :1]) * np.sin(2 * V[:, 1:2] + 1.3 * V[:, 2:] + 0.4)
    V = V.astype(np.float32)
    other = partner_of(V, 1e-3)
    assert (other >= 0).all()
    first = np.arange(len(V)) < other
    V[other[first]] = V[first] * FLIP_X
    V[other == np.arange(len(V)), 0] = 0.0
    set_position(obj.data, V)
    return obj


def partner_of(V, tolerance, flip=FLIP_X):
    """Return the vertex nearest to the image of each, -1 where that is too far; by brute force."""
    result = np.full(len(V), -1)
    for number, image in enumerate(V * flip):
        distance = np.linalg.norm(V - image, axis=1)
        nearest = int(distance.argmin())
        if distance[nearest] <= tolerance:
            result[number] = nearest
    return result
