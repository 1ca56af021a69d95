# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole run: load, cubify, save, picture, report."""

import contextlib
import time
from argparse import Namespace
from collections.abc import Iterator

from ...solver.console.output import InputError
from ...solver.errors import CubicCraftError
from ..environment.requirements import new_engine_warnings
from .picture.gallery import build_gallery
from .picture.render import render
from .picture.studio import furnish
from .process.output_files import meshes, numbered, per_cubeness
from .process.progress import ProgressBar
from .reading.load_meshes import FormMesh, Loaded, empty_blender, load, make_form, read_form
from .solving.bake_frames import bake_frames
from .solving.cubify_all import cubify_all
from .writing.report import write_animation_report, write_report
from .writing.save_meshes import check_exporter, save_meshes


def run(options: Namespace, begin: float) -> None:
    """Do what the command line says.

    `options`: from `arguments.parse`. `begin`: `time.perf_counter` at the start of the script, for
    the report. Raises InputError: the input, an option or an output cannot be used.
    """
    empty_blender()
    if options.save_mesh:
        check_exporter(options.save_mesh)
    form = read_form(options.form_object, options.verbose) if options.form_object else None
    capture = read_form(options.capture, options.verbose) if options.capture else None
    _run(options, form, capture, begin)


def _run(options: Namespace, form: FormMesh | None, capture: FormMesh | None, begin: float) -> None:
    bar = ProgressBar(is_silent=bool(options.worker))
    seconds: dict[str, float] = {}
    with _timed("load", seconds):
        loaded = load(
            options.input,
            options.object,
            options.verbose,
            is_seen=not options.bake,
            is_all_seen=options.with_modifiers,
        )
        loaded.form = make_form(form) if form else None
        loaded.capture = make_form(capture, options.capture.stem) if capture else None
    for name in loaded.covered:
        bar.say(f'"{name}": what is seen is taken, as its modifiers show a shape of their own')
    if options.bake:
        _bake(loaded, options, bar, seconds, begin)
        return
    try:
        sculptures = cubify_all(loaded, options, bar)
    except CubicCraftError as error:
        raise InputError(f"{options.input or 'monkey'}: {error}") from error
    for notice in new_engine_warnings():
        bar.say(notice)
    with _timed("write", seconds):
        if options.save_mesh:
            paths = per_cubeness(options.save_mesh, options.cubeness)
            levels, verbose = options.low_poly, options.verbose
            for problem in save_meshes(paths, sculptures, loaded, levels, verbose):
                bar.warn(problem)
            done = meshes(options.save_mesh, options.cubeness, levels)
            bar.say(f"wrote {', '.join(map(str, done))}")
    with _timed("render", seconds):
        if options.output:
            gallery = build_gallery(sculptures, options)
            furnish(gallery, options.resolution[0] / options.resolution[1])
            for path in render(gallery, numbered(options.output, options.turntable), options):
                bar.say(f"wrote {path}")
    seconds["total"] = time.perf_counter() - begin
    if options.report:
        write_report(options.report, sculptures, options, seconds)
        bar.say(f"wrote {options.report}")


def _bake(
    loaded: Loaded, options: Namespace, bar: ProgressBar, seconds: dict[str, float], begin: float
) -> None:
    try:
        with _timed("bake", seconds):
            animation = bake_frames(loaded, options, bar)
    except CubicCraftError as error:
        raise InputError(f"{options.input or 'monkey'}: {error}") from error
    seconds["total"] = time.perf_counter() - begin
    if options.report:
        write_animation_report(options.report, animation, options, seconds)
        bar.say(f"wrote {options.report}")


@contextlib.contextmanager
def _timed(name: str, seconds: dict[str, float]) -> Iterator[None]:
    begin = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - begin
