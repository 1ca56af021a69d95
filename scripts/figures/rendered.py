# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures that Blender renders, one after the other in one session."""

from argparse import Namespace
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
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
from cubic_craft.cubic_craft_addon.command_line.process.progress import task

from .compositions import (
    by_crispness,
    by_cubeness,
    by_form,
    by_orientation,
    handles,
    in_two_rows,
    teaser,
    uv_texture,
    versions_of,
)
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


_bunny = partial(versions_of, name="bunny", instead="monkey")
_fox, _bear = (partial(versions_of, name=name, is_shaded=True) for name in ("fox", "bear"))
FIGURES = {
    "1": Figure("figure_1_teaser", teaser, 860, in_two_rows),
    "2": Figure("figure_2_uv_texture", uv_texture, 560),
    "3": Figure("figure_3_handles", handles, 560),
    "5": Figure("figure_5_cubeness", partial(_bunny, versions=by_cubeness), 460),
    "6": Figure(
        "figure_6_orientations", partial(_bunny, versions=by_orientation, has_original=False), 520
    ),
    "character": Figure("figure_character", partial(_fox, versions=by_crispness), 620),
    "forms": Figure("figure_forms", partial(_bear, versions=by_form, has_original=False), 700),
}


def render_figures(wanted: list[str], options: Namespace) -> None:
    """Render figures to ``options.output``, each as a PNG of ``options.width`` pixels.

    `wanted`: keys of `FIGURES`. `options`: from the command line. Raises InputError: a mesh cannot
    be read, or a file cannot be written.
    """
    with registered():
        meshes = FigureMeshes(options.meshes, options.rough)
        for number in wanted:
            with task(f"figure {number}") as shown:
                shown.summary = f"wrote {_rendered(FIGURES[number], meshes, options)}"


def _rendered(figure: Figure, meshes: FigureMeshes, options: Namespace) -> Path:
    groups = figure.compose(meshes)
    scene = scene_for_gallery()
    for group in groups:
        for copy in group.copies:
            scene.collection.objects.link(copy)
    gallery = figure.arrange(groups, scene, (NOMINAL_WIDTH, figure.height))
    furnish(gallery, NOMINAL_WIDTH / figure.height)
    path = options.output / f"{figure.name}.png"
    height = round(options.width * figure.height / NOMINAL_WIDTH)
    how = Namespace(**vars(options), resolution=(options.width, height), turntable=0)
    list(render(gallery, [path], how))
    return path
