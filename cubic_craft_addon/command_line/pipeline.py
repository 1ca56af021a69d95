# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole run: load, cubify, save, picture, report."""

import contextlib
import time
from argparse import Namespace
from collections.abc import Iterator
from typing import Any

from ...solver.console.many import write_json
from ...solver.console.output import refusals_of
from ..environment.requirements import new_engine_warnings
from ..send.targets import check_exporter
from .picture.gallery import build_gallery
from .picture.render import render
from .picture.studio import furnish
from .process.output_files import meshes, numbered, per_cubeness
from .process.progress import say
from .reading.form_mesh import make_form, read_form
from .reading.load_meshes import Loaded, empty_blender, load
from .solving.bake_frames import bake_frames
from .solving.cubify_all import cubify_all
from .writing.report import about_sculptures, report_of
from .writing.save_meshes import save_meshes


def run(options: Namespace, begin: float) -> dict[str, Any]:
    """Do what the command line says for one file, and return the report, which is also written.

    `options`: from `arguments.parse` or `options_for`. `begin`: `time.perf_counter` at the start,
    for the report. Raises InputError: the input, an option or an output cannot be used.
    """
    empty_blender()
    if options.save_mesh:
        with refusals_of(options.save_mesh):
            check_exporter(options.save_mesh.suffix)
    seconds: dict[str, float] = {}
    loaded = _load(options, seconds)
    for name in loaded.covered:
        say(f'"{name}": what is seen is taken, as its modifiers show a shape of their own')
    with refusals_of(options.input or "monkey"):
        about = _made(loaded, options, seconds)
    seconds["total"] = time.perf_counter() - begin
    report = report_of(about, options, seconds)
    if options.report:
        write_json(options.report, report)
        say(f"wrote {options.report}")
    return report


def _load(options: Namespace, seconds: dict[str, float]) -> Loaded:
    form = read_form(options.form_object) if options.form_object else None
    with _timed("load", seconds):
        loaded = load(
            options.input,
            options.object,
            is_seen=not options.bake,
            is_all_seen=options.with_modifiers,
        )
        loaded.form = make_form(form) if form else None
    return loaded


def _made(loaded: Loaded, options: Namespace, seconds: dict[str, float]) -> dict[str, Any]:
    """Write an animation, or meshes and a picture; return what there is to report."""
    if options.bake:
        with _timed("bake", seconds):
            return bake_frames(loaded, options)
    sculptures = cubify_all(loaded, options)
    for notice in new_engine_warnings():
        say(notice)
    with _timed("write", seconds):
        if options.save_mesh:
            paths = per_cubeness(options.save_mesh, options.cubeness)
            for problem in save_meshes(paths, sculptures, loaded, options.low_poly):
                say(problem)
            done = meshes(options.save_mesh, options.cubeness, options.low_poly)
            say(f"wrote {', '.join(map(str, done))}")
    with _timed("render", seconds):
        if options.output:
            gallery = build_gallery(sculptures, options)
            furnish(gallery, options.resolution[0] / options.resolution[1])
            for path in render(gallery, numbered(options.output, options.turntable), options):
                say(f"wrote {path}")
    return about_sculptures(sculptures, options.cubeness)


@contextlib.contextmanager
def _timed(name: str, seconds: dict[str, float]) -> Iterator[None]:
    begin = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - begin
