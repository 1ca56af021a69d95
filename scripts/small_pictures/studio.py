# SPDX-License-Identifier: GPL-3.0-or-later
"""Camera, light and format of the small pictures in the panel: of presets and of forms."""

import math
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler, Vector

from cubic_craft.cubic_craft_addon.command_line.picture.studio import add_sun, light_around

LIGHTS = (
    # turn about the camera's up and right axes in degrees, strength, angular size in degrees
    ((-38.0, -36.0), 2.7, 8.0),
    ((60.0, -5.0), 0.5, 60.0),
    ((150.0, -35.0), 1.2, 20.0),
)


VIEW = (math.radians(72.0), 0.0, math.radians(28.0))
"""Euler angles of the camera"""


def set_up(
    pixels: int,
    width: float,
    samples: int,
    view: tuple[float, float, float] = VIEW,
    lift: float = 0,
) -> bpy.types.Scene:
    """Give the scene a camera, lights and no background.

    `pixels`: along a side. `width`: of what is seen. `lift`: of the middle of the picture above the
    origin, in the picture.
    """
    scene = bpy.context.scene
    turn = Euler(view).to_matrix()
    lens = bpy.data.cameras.new("Camera")
    lens.type, lens.ortho_scale = "ORTHO", width
    camera = bpy.data.objects.new("Camera", lens)
    camera.rotation_euler = view
    camera.location = turn @ Vector((0.0, lift, 10.0))
    scene.collection.objects.link(camera)
    scene.camera = camera
    for (about_up, about_right), strength, size in LIGHTS:
        aside = Euler((math.radians(about_right), math.radians(about_up), 0.0), "XYZ")
        add_sun(scene, "Light", (turn @ aside.to_matrix()).to_euler(), strength, size)
    light_around(scene, (0.85, 0.9, 1.0), 0.35)
    scene.view_settings.view_transform = "Standard"
    scene.cycles.samples, scene.cycles.use_denoising = samples, True
    scene.cycles.device = "CPU"
    settings = scene.render
    settings.engine = "CYCLES"
    settings.resolution_x = settings.resolution_y = pixels
    settings.film_transparent = True
    settings.dither_intensity = 0.0  # it would make the file twice as large
    settings.image_settings.file_format = "PNG"
    settings.image_settings.color_mode = "RGBA"
    settings.image_settings.compression = 100
    return scene


def render(scene: bpy.types.Scene, path: Path, largest: int, levels: int = 256) -> None:
    """Write a picture of what is in the scene.

    `largest`: of the file, in bytes. `levels`: of each channel; fewer make the file smaller, as
    what is left of the noise vanishes. Raises SystemExit: the file is too large to be part of the
    extension.
    """
    bpy.ops.render.render(scene=scene.name)
    bpy.data.images["Render Result"].save_render(str(path), scene=scene)
    if levels < 256:
        _round(scene, path, levels)
    size = path.stat().st_size
    print(f"{path.name}: {size} bytes")
    if size > largest:
        raise SystemExit(f"{path.name} is larger than {largest} bytes")


def _round(scene: bpy.types.Scene, path: Path, levels: int) -> None:
    image = bpy.data.images.load(str(path))
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    image.pixels.foreach_set(np.round(pixels * (levels - 1)) / (levels - 1))
    image.save_render(str(path), scene=scene)
    bpy.data.images.remove(image)
