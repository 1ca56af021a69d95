# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of each form for the panel: what a ball would become.

The bodies are those that the solver uses. What an object gives is shown by a pebble, and what its
directions give by arrows.
"""

import math
from typing import Any

import bmesh
import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

from cubic_craft.cubic_craft_addon.command_line.picture.studio import surface
from cubic_craft.cubic_craft_addon.form.body import form_of
from cubic_craft.cubic_craft_addon.form.pictures import path_of
from cubic_craft.cubic_craft_addon.settings.values import Settings
from cubic_craft.solver.styles.form_names import FORMS
from cubic_craft.solver.styles.forms import cube, rhombic_dodecahedron

from .studio import render, set_up

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
VIEW = (math.radians(64.0), 0.0, math.radians(24.0))
AMBER, GREY = (0.62, 0.27, 0.06), (0.36, 0.39, 0.44)
"""linear RGB, of the named forms and of those from other objects"""
BEVEL = 0.035
"""so that edges catch the light; of a body that fills the picture"""


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
    corners = [edited.verts.new(point) for point in points]
    bmesh.ops.convex_hull(edited, input=corners)
    bmesh.ops.dissolve_limit(
        edited, angle_limit=math.radians(1.0), verts=edited.verts, edges=edited.edges
    )


def _add_arrows(edited: bmesh.types.BMesh, axes: np.ndarray) -> None:
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


def render_forms(only: list[str] | None, samples: int) -> None:
    """Render all, or those that are named."""
    scene = set_up(96, 2.1, samples, VIEW)
    amber = surface("Amber", AMBER, roughness=1.0)
    grey = surface("Grey", GREY, roughness=1.0)
    for form, *_ in FORMS:
        if not only or form in only:
            mesh = body_of(form)
            mesh.materials.append(grey if form in FROM_OBJECTS else amber)
            body = _fill_picture(scene, mesh)
            render(scene, path_of(form), largest=8_000, levels=64)
            bpy.data.objects.remove(body)


def _fill_picture(scene: bpy.types.Scene, mesh: bpy.types.Mesh) -> bpy.types.Object:
    turn = np.array(Euler(VIEW).to_matrix())
    points = np.array([vertex.co for vertex in mesh.vertices]) @ turn
    low, high = points.min(axis=0), points.max(axis=0)
    size = 2.0 / (high - low)[:2].max()
    body = bpy.data.objects.new(mesh.name, mesh)
    body.scale = [size] * 3
    body.location = Vector(turn @ (-(low + high) / 2 * size))
    scene.collection.objects.link(body)
    bevel = body.modifiers.new("Bevel", "BEVEL")
    bevel.width, bevel.segments = BEVEL / size, 3
    bevel.angle_limit = math.radians(20.0)
    return body
