# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures that Blender renders, one after the other in one session."""

from argparse import Namespace
from pathlib import Path

import bpy
from headless.extension import registered
from headless.load_meshes import empty_blender
from headless.progress import ProgressBar
from headless.render import render

from . import cubeness, handles, orientations, teaser, uv_texture
from .figure_meshes import FigureMeshes
from .picture import Picture

__all__ = ("render_figures",)

COMPOSERS = {
    "1": ("figure_1_teaser", teaser.compose),
    "2": ("figure_2_uv_texture", uv_texture.compose),
    "3": ("figure_3_handles", handles.compose),
    "5": ("figure_5_cubeness", cubeness.compose),
    "6": ("figure_6_orientations", orientations.compose),
}


def render_figures(wanted: list[str], options: Namespace, root: Path) -> None:
    """Render figures to ``options.output``, each as a PNG of ``options.width`` pixels.

    Parameters
    ----------
    wanted : keys of `COMPOSERS`
    options : from the command line
    root : folder of the extension

    Raises
    ------
    InputError
        A mesh cannot be read, or a file cannot be written.
    """
    empty_blender()
    bar = ProgressBar()
    with registered(root) as extension:
        meshes = FigureMeshes(extension, root, options.meshes, bar, options.verbose)
        for number in wanted:
            name, compose = COMPOSERS[number]
            picture = compose(meshes)
            path = options.output / f"{name}.png"
            with bar.task(f"figure {number}") as task:
                _render(picture, path, options)
                task.finish(f"wrote {path}")
            if options.save_blend:
                _save(options.save_blend / f"{name}.blend")


def _render(picture: Picture, path: Path, options: Namespace) -> None:
    settings = Namespace(
        engine=options.engine,
        samples=options.samples,
        resolution=picture.resolution(options.width),
        turntable=0,
        threads=None,  # all
        verbose=options.verbose,
    )
    for _ in render(picture.gallery, [path], settings):
        pass


def _save(path: Path) -> None:
    """Save what belongs to the scene that is shown."""
    bpy.data.libraries.write(str(path.resolve()), {bpy.context.scene}, fake_user=True)
