# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a picture of each form for the panel: what a ball would become.

The bodies are those that the solver uses. What an object gives is shown by a pebble, and what its
directions give by arrows.
"""

import argparse
import math
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

import bpy  # noqa: E402
import numpy as np  # noqa: E402
from mathutils import Euler, Vector  # noqa: E402
from preset_pictures.studio import Picture, render, set_up  # noqa: E402

from cubic_craft import registered  # noqa: E402
from cubic_craft.cubic_craft_addon.command_line.picture.studio import surface  # noqa: E402
from cubic_craft.cubic_craft_addon.form.pictures import path_of  # noqa: E402
from cubic_craft.solver.styles.form_names import FORMS  # noqa: E402
from form_pictures.bodies import FROM_OBJECTS, body_of  # noqa: E402

VIEW = (math.radians(64.0), 0.0, math.radians(24.0))
PICTURE = Picture(size=96, width=2.1, view=VIEW, levels=64, largest_bytes=8_000)
AMBER, GREY = (0.62, 0.27, 0.06), (0.36, 0.39, 0.44)
"""linear RGB, of the named forms and of those from other objects"""
BEVEL = 0.035
"""so that edges catch the light; of a body that fills the picture"""


def main() -> None:
    """Render all, or those that are named."""
    parser = argparse.ArgumentParser(prog="form_pictures", description=__doc__)
    parser.add_argument("--only", nargs="+", metavar="FORM", help="(default: all)")
    parser.add_argument("--samples", type=int, default=256, metavar="N", help="(default: 256)")
    options = parser.parse_args()
    with registered():
        scene = set_up(PICTURE, options.samples)
        amber = surface("Amber", AMBER, roughness=1.0)
        grey = surface("Grey", GREY, roughness=1.0)
        for form, *_ in FORMS:
            if not options.only or form in options.only:
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


if __name__ == "__main__":
    main()
