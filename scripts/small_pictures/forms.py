# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of each form for the panel: what a ball would become.

The bodies are those that the solver uses. What an object gives is shown by a pebble, and what its
directions give by arrows.
"""

import math

import bpy
import numpy as np
from mathutils import Euler, Vector

from cubic_craft.cubic_craft_addon.command_line.picture.studio import surface
from cubic_craft.cubic_craft_addon.form.pictures import path_of
from cubic_craft.solver.styles.form_names import FORMS

from .bodies import FROM_OBJECTS, body_of
from .studio import Picture, render, set_up

VIEW = (math.radians(64.0), 0.0, math.radians(24.0))
PICTURE = Picture(size=96, width=2.1, view=VIEW, levels=64, largest_bytes=8_000)
AMBER, GREY = (0.62, 0.27, 0.06), (0.36, 0.39, 0.44)
"""linear RGB, of the named forms and of those from other objects"""
BEVEL = 0.035
"""so that edges catch the light; of a body that fills the picture"""


def render_forms(only: list[str] | None, samples: int) -> None:
    """Render all, or those that are named."""
    scene = set_up(PICTURE, samples)
    amber = surface("Amber", AMBER, roughness=1.0)
    grey = surface("Grey", GREY, roughness=1.0)
    for form, *_ in FORMS:
        if not only or form in only:
            mesh = body_of(form)
            mesh.materials.append(grey if form in FROM_OBJECTS else amber)
            body = _fill_picture(scene, mesh)
            render(scene, path_of(form), PICTURE)
            bpy.data.objects.remove(body)


def _fill_picture(scene: bpy.types.Scene, mesh: bpy.types.Mesh) -> bpy.types.Object:
    """Add an object with the mesh, as large as the picture and in its middle."""
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
