# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a picture of each preset that comes with the extension, beside its file.

The settings are taken from the files, the picture of what has none shows the bear as it was.
"""

import argparse
import math
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

import bpy  # noqa: E402
from figures.shapes import bear as add_bear  # noqa: E402
from headless.extension import Extension, registered  # noqa: E402
from headless.load_meshes import empty_blender  # noqa: E402
from headless.studio import surface  # noqa: E402
from mathutils import Euler, Vector  # noqa: E402

WITHOUT = "preset_without_picture"
SIZE = 160
"""pixels"""
LARGEST_BYTES = 30_000
FUR, GREY = (0.62, 0.27, 0.06), (0.30, 0.31, 0.33)
"""linear RGB"""
VIEW = (math.radians(72.0), 0.0, math.radians(28.0))
WIDTH = 2.62
"""of what is seen, in the units of the bear"""
LIGHTS = (
    # turn about the camera's up and right axes in degrees, strength, angular size in degrees
    ((-38.0, -36.0), 2.7, 8.0),
    ((60.0, -5.0), 0.5, 60.0),
    ((150.0, -35.0), 1.2, 20.0),
)


def main() -> None:
    """Render all, or those that are named."""
    parser = argparse.ArgumentParser(prog="preset_pictures", description=__doc__)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="(default: all)")
    parser.add_argument("--samples", type=int, default=64, metavar="N", help="(default: 64)")
    options = parser.parse_args()
    empty_blender()
    with registered(ROOT) as extension:
        bear = add_bear()
        fur = surface("Fur", FUR, roughness=0.5)
        bear.data.materials.append(fur)
        scene = _studio(options.samples)
        _render_presets(scene, bear, extension, options.only)
        folder = extension.presets.INCLUDED_FOLDER.parents[1]
        if not options.only or WITHOUT in options.only:
            bear.data.materials[0] = surface("Grey", GREY, roughness=0.5)
            _render(scene, folder / f"{WITHOUT}.png")


def _render_presets(
    scene: bpy.types.Scene, bear: Any, extension: Extension, only: list[str] | None
) -> None:
    original = extension.mesh_bridge.original_positions(bear.data)
    for preset in extension.presets.presets():
        if preset.is_included and (not only or preset.identifier in only):
            settings = extension.settings.Settings(symmetry=(True, False, False), **preset.values)
            member = extension.member.read_member(bear, settings)
            (solution,) = extension.pipeline.solve(extension.assembly.prepare([member]))
            _move(bear, solution.positions)
            _render(scene, preset.picture)
            _move(bear, original)


def _move(bear: Any, positions: Any) -> None:
    bear.data.vertices.foreach_set("co", positions.ravel())
    bear.data.update()


def _studio(samples: int) -> bpy.types.Scene:
    """Give the scene a camera, lights and no background."""
    scene = bpy.context.scene
    turn = Euler(VIEW).to_matrix()
    lens = bpy.data.cameras.new("Camera")
    lens.type, lens.ortho_scale = "ORTHO", WIDTH
    camera = bpy.data.objects.new("Camera", lens)
    camera.rotation_euler = VIEW
    camera.location = turn @ Vector((0.0, 0.06, 10.0))
    scene.collection.objects.link(camera)
    scene.camera = camera
    for (about_up, about_right), strength, size in LIGHTS:
        light = bpy.data.lights.new("Light", "SUN")
        light.energy, light.angle = strength, math.radians(size)
        lamp = bpy.data.objects.new("Light", light)
        aside = Euler((math.radians(about_right), math.radians(about_up), 0.0), "XYZ")
        lamp.rotation_euler = (turn @ aside.to_matrix()).to_euler()
        scene.collection.objects.link(lamp)
    world = bpy.data.worlds.new("World")
    if world.node_tree is None:  # before Blender 5.0
        world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.85, 0.9, 1.0, 1.0)
    background.inputs["Strength"].default_value = 0.35
    scene.world = world
    scene.view_settings.view_transform = "Standard"
    scene.cycles.samples, scene.cycles.use_denoising = samples, True
    scene.cycles.device = "CPU"
    settings = scene.render
    settings.engine = "CYCLES"
    settings.resolution_x = settings.resolution_y = SIZE
    settings.film_transparent = True
    settings.dither_intensity = 0.0  # it would make the file twice as large
    settings.image_settings.file_format = "PNG"
    settings.image_settings.color_mode = "RGBA"
    settings.image_settings.compression = 100
    return scene


def _render(scene: bpy.types.Scene, path: Path) -> None:
    bpy.ops.render.render(scene=scene.name)
    bpy.data.images["Render Result"].save_render(str(path), scene=scene)
    size = path.stat().st_size
    print(f"{path.name}: {size} bytes")
    if size > LARGEST_BYTES:
        raise SystemExit(f"{path.name} is larger than {LARGEST_BYTES} bytes")


if __name__ == "__main__":
    main()
