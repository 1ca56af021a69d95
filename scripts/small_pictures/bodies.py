# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands for each form in its picture, as a mesh."""

import math
from typing import Any

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

from cubic_craft.cubic_craft_addon.form.body import form_of
from cubic_craft.cubic_craft_addon.settings.values import Settings
from cubic_craft.solver.styles.forms import cube, rhombic_dodecahedron

FROM_OBJECTS = ("OBJECT", "DIRECTIONS", "FACES")
"""forms that are what the artist makes of them; their pictures have another color"""
SETTINGS = {"BOX": {"form_weights": (0.8, 1.0, 0.4)}, "PYRAMID": {"form_sides": 4}}
"""where it is not the default that is shown"""
SMOOTH_BELOW = math.radians(12.0)
"""between two faces; more than between the walls of a cylinder"""
PEBBLE_SEED, PEBBLE_CORNERS, PEBBLE = 4, 22, (1.0, 0.72, 0.62)
"""number of corners, and radii"""
TURN = math.radians(-21.0)
"""of the arrows about Z, so that none points at the camera"""
BALL = 0.6
"""radius, beside arrows that reach to 1"""
GEM = 0.72
"""distance of the sides of the gem with arrows on them"""
SHAFT, HEAD, HEAD_LENGTH = 0.09, 0.24, 0.36
"""radii of an arrow, and the length of its head"""
ARROW_SIDES = 24


def body_of(form: str) -> bpy.types.Mesh:
    """Return the mesh of a form, one of the identifiers of the settings."""
    edited = bmesh.new()
    if form == "DIRECTIONS":
        bmesh.ops.create_icosphere(edited, subdivisions=4, radius=BALL)
        axes = np.array(Matrix.Rotation(TURN, 3, "Z")).T
        _add_arrows(edited, np.concatenate([axes, -axes]))
    elif form == "FACES":
        gem = rhombic_dodecahedron()
        _add_hull(edited, gem.vertices * GEM / gem.offsets.min())
        _add_arrows(edited, gem.normals[gem.normals[:, 2] > 0.1])  # as if these were selected
    elif form == "OBJECT":
        _add_hull(edited, _pebble())
    else:
        _add_hull(edited, _vertices(form))
    mesh = bpy.data.meshes.new(form)
    edited.to_mesh(mesh)
    edited.free()
    mesh.shade_smooth()
    mesh.set_sharp_from_angle(angle=SMOOTH_BELOW)
    return mesh


def _vertices(form: str) -> Any:
    settings = Settings(form=form, **SETTINGS.get(form, {}))
    body = form_of(settings)
    return cube().vertices if body is None else body.vertices


def _pebble() -> np.ndarray:
    points = np.random.default_rng(PEBBLE_SEED).normal(size=(PEBBLE_CORNERS, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True) * PEBBLE


def _add_hull(edited: bmesh.types.BMesh, points: np.ndarray) -> None:
    """Add the convex hull, each flat side as one face."""
    corners = [edited.verts.new(point) for point in points]
    bmesh.ops.convex_hull(edited, input=corners)
    bmesh.ops.dissolve_limit(
        edited, angle_limit=math.radians(1.0), verts=edited.verts, edges=edited.edges
    )


def _add_arrows(edited: bmesh.types.BMesh, axes: np.ndarray) -> None:
    """Add an arrow along each of the axes (n,3)."""
    for axis in axes:
        turn = Vector((0.0, 0.0, 1.0)).rotation_difference(Vector(axis)).to_matrix().to_4x4()
        for low, high, radius, top in (
            (BALL, 1.0, SHAFT, SHAFT),
            (1.0, 1.0 + HEAD_LENGTH, HEAD, 0.0),
        ):
            middle = Matrix.Translation((0.0, 0.0, (low + high) / 2))
            bmesh.ops.create_cone(
                edited,
                cap_ends=True,
                segments=ARROW_SIDES,
                radius1=radius,
                radius2=top,
                depth=high - low,
                matrix=turn @ middle,
            )
