# SPDX-License-Identifier: GPL-3.0-or-later
"""Normal captures: one mesh with each of several balls, which stand beside it."""

import bmesh
import bpy
import numpy as np
from mathutils import Matrix

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.command_line.picture.studio import FINISHES, surface
from cubic_craft.cubic_craft_addon.mesh_bridge import read_values

from .figure_meshes import FigureMeshes, stand_beside

STRENGTH = 0.6
SIDES = 14
"""planes that the hewn ball is cut along"""
RADIUS = 0.17
"""of a ball, relative to the largest side of the mesh"""


def hewn(d: np.ndarray) -> np.ndarray:
    """Return the directions (n,3) on a stone with flat sides, all about as far away."""
    golden = np.pi * (3.0 - np.sqrt(5.0)) * np.arange(SIDES)
    z = 1.0 - (2.0 * np.arange(SIDES) + 1.0) / SIDES
    r = np.sqrt(1.0 - z * z)
    planes = np.stack([r * np.cos(golden), r * np.sin(golden), z], axis=1)
    return d / (d @ planes.T).max(axis=1)[:, None]


def spun(d: np.ndarray) -> np.ndarray:
    """Return the directions (n,3) on a spinning top: two cones with a round edge."""
    radius = np.hypot(d[:, 0], d[:, 1])
    return d / (radius**1.3 + np.abs(d[:, 2]) ** 1.3)[:, None] ** (1 / 1.3)


def squared(d: np.ndarray) -> np.ndarray:
    """Return the directions (n,3) on a cushion with sides and round edges."""
    return d / (np.abs(d) ** 6).sum(axis=1)[:, None] ** (1 / 6)


BALLS = {"a cushion": squared, "a hewn stone": hewn, "a spinning top": spun}


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the original, and what becomes of it with each ball."""
    (model,) = meshes.there([], instead=["monkey"])
    clay = surface("Ball", *FINISHES["clay"])
    groups = [meshes.group(model, model.original, "original", "grey")]
    for label, shape in BALLS.items():
        ball = _ball(shape, clay)
        settings = {"capture_object": ball, "capture_strength": STRENGTH}
        positions = meshes.cubified(model, 0.0, **settings)
        group = meshes.group(model, positions, label, "green")
        size = RADIUS * group.extent
        stand_beside(group, ball, Matrix.Scale(size, 4))
        groups.append(group)
    return groups


def _ball(shape, clay: bpy.types.Material) -> bpy.types.Object:
    """Return a ball whose vertices have been moved along their directions, in no scene."""
    edited = bmesh.new()
    bmesh.ops.create_icosphere(edited, subdivisions=6, radius=1.0)
    mesh = bpy.data.meshes.new("Ball")
    edited.to_mesh(mesh)
    edited.free()
    directions = read_values(mesh.vertices, "co", width=3).astype(np.float64)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    mesh.vertices.foreach_set("co", shape(directions).astype(np.float32).ravel())
    mesh.materials.append(clay)
    return bpy.data.objects.new("Ball", mesh)
