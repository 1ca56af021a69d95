# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures that Blender renders, one after the other in one session."""

from argparse import Namespace
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import bpy

from cubic_craft import registered
from cubic_craft.cubic_craft_addon.command_line.picture.gallery import (
    Gallery,
    Group,
    arrange,
    scene_for_gallery,
)
from cubic_craft.cubic_craft_addon.command_line.picture.render import render
from cubic_craft.cubic_craft_addon.command_line.picture.studio import furnish
from cubic_craft.cubic_craft_addon.command_line.process.progress import ProgressBar

from . import handles, teaser, uv_texture, versions
from .figure_meshes import FigureMeshes

NOMINAL_WIDTH = 1600


@dataclass(frozen=True)
class Figure:
    """A picture of groups that stand side by side, unless they are arranged otherwise."""

    name: str
    compose: Callable[[FigureMeshes], list[Group]]
    """returns groups whose copies are in no scene yet"""
    height: int
    """pixels, of a picture `NOMINAL_WIDTH` pixels wide"""
    arrange: Callable[[list[Group], bpy.types.Scene, tuple[int, int]], Gallery] = arrange


def _versions(*what, **how) -> Callable[[FigureMeshes], list[Group]]:
    return lambda meshes: versions.compose(meshes, *what, **how)


FIGURES = {
    "1": Figure("figure_1_teaser", teaser.compose, 860, teaser.in_two_rows),
    "2": Figure("figure_2_uv_texture", uv_texture.compose, 560),
    "3": Figure("figure_3_handles", handles.compose, 560),
    "5": Figure("figure_5_cubeness", _versions("bunny", "monkey", versions.by_cubeness), 460),
    "6": Figure(
        "figure_6_orientations",
        _versions("bunny", "monkey", versions.by_orientation, has_original=False),
        520,
    ),
    "character": Figure(
        "figure_character", _versions("fox", "fox", versions.by_crispness, is_shaded=True), 620
    ),
    "forms": Figure(
        "figure_forms",
        _versions("bear", "bear", versions.by_form, has_original=False, is_shaded=True),
        700,
    ),
}


def render_figures(wanted: list[str], options: Namespace) -> None:
    """Render figures to ``options.output``, each as a PNG of ``options.width`` pixels.

    `wanted`: keys of `FIGURES`. `options`: from the command line. Raises InputError: a mesh cannot
    be read, or a file cannot be written.
    """
    bar = ProgressBar()
    with registered():
        meshes = FigureMeshes(options.meshes, bar, options.rough)
        for number in wanted:
            with bar.task(f"figure {number}") as task:
                path = render_figure(FIGURES[number], meshes, options)
                task.finish(f"wrote {path}")


def render_figure(figure: Figure, meshes: FigureMeshes, options: Namespace) -> Path:
    """Render a figure as `render_figures` does, and return the path of the picture."""
    groups = figure.compose(meshes)
    scene = scene_for_gallery()
    for group in groups:
        for copy in group.copies:
            scene.collection.objects.link(copy)
    gallery = figure.arrange(groups, scene, (NOMINAL_WIDTH, figure.height))
    furnish(gallery, NOMINAL_WIDTH / figure.height)
    path = options.output / f"{figure.name}.png"
    settings = {
        **{name: getattr(options, name) for name in ("engine", "samples")},
        "resolution": (options.width, round(options.width * figure.height / NOMINAL_WIDTH)),
        "turntable": 0,
    }
    list(render(gallery, [path], Namespace(**settings)))
    return path
