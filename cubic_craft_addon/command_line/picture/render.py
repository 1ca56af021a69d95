# SPDX-License-Identifier: GPL-3.0-or-later
"""Render the gallery to PNG files."""

import contextlib
import math
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path

import bpy

from ....solver.console.output import InputError, replacing
from ..process.quiet import captured
from ..reading.load_meshes import reason
from .gallery import Gallery

ENGINES = {"cycles": "CYCLES", "workbench": "BLENDER_WORKBENCH"}
BOUNCES = 4


def render(gallery: Gallery, paths: list[Path], options: Namespace) -> Iterator[Path]:
    """Render one picture, or one per path of a full turn, and yield each path when it is done.

    Raises InputError: the engine does not work on this machine, or a file cannot be written.
    """
    scene = gallery.scene
    _set_up(scene, options)
    begin = [turntable.rotation_euler.z for turntable in gallery.turntables]
    for number, path in enumerate(paths):
        for turntable, angle in zip(gallery.turntables, begin, strict=True):
            turntable.rotation_euler.z = angle + math.tau * number / len(paths)
        with captured(), replacing(path) as temporary:
            _render_still(scene, temporary.resolve(), options.engine)
        yield path


def _set_up(scene: bpy.types.Scene, options: Namespace) -> None:
    settings = scene.render
    settings.engine = ENGINES[options.engine]
    settings.resolution_x, settings.resolution_y = options.resolution
    settings.resolution_percentage = 100
    settings.image_settings.file_format = "PNG"
    settings.image_settings.color_mode = "RGB"
    # Dither would make the file twice as large; there are no bands to be seen without it.
    settings.dither_intensity = 0.0
    settings.image_settings.compression = 90
    settings.use_persistent_data = options.turntable > 1
    settings.use_file_extension = False
    if options.engine == "cycles":
        _set_up_cycles(scene, options.samples)
    else:
        _set_up_workbench(scene)


def _set_up_workbench(scene: bpy.types.Scene) -> None:
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.exposure = 0.8
    scene.display.render_aa = "16"
    scene.display.light_direction = (0.6, 0.65, -0.45)
    shading = scene.display.shading
    shading.light = "STUDIO"
    shading.color_type = "MATERIAL"
    shading.show_cavity = True
    shading.show_shadows = True
    shading.shadow_intensity = 0.25


def _set_up_cycles(scene: bpy.types.Scene, samples: int) -> None:
    import _cycles  # pyright: ignore[reportMissingImports]  # only there inside Blender

    scene.view_settings.view_transform = "AgX"
    with contextlib.suppress(TypeError):  # other color configurations have other looks
        scene.view_settings.look = "AgX - Medium High Contrast"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.max_bounces = BOUNCES
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.use_denoising = bool(_cycles.with_openimagedenoise)
    if cycles.use_denoising:
        cycles.denoiser = "OPENIMAGEDENOISE"
        # Guides without noise of their own (no depth of field, no motion) need no filter first.
        cycles.denoising_prefilter = "FAST"


def _render_still(scene: bpy.types.Scene, path: Path, engine: str) -> None:
    try:
        bpy.ops.render.render(scene=scene.name)
        # Not by `write_still`, which takes {braces} in a path for a template.
        bpy.data.images["Render Result"].save_render(str(path), scene=scene)
    except RuntimeError as error:
        raise InputError(f"--engine {engine}: {reason(error)}; {_cure(engine)}") from error
    if not path.is_file():
        raise InputError(f"--engine {engine}: rendered nothing; {_cure(engine)}")


def _cure(engine: str) -> str:
    if engine == "workbench":
        return "it needs a display or a GPU with EGL; choose --engine cycles"
    return "see its own messages with --verbose"
