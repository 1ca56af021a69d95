# SPDX-License-Identifier: GPL-3.0-or-later
"""Save results as mesh files, each as `send.targets` has it."""

import contextlib
import uuid
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import bpy

from ....solver.console.output import InputError, refusals_of, replacing
from ...run import pipeline
from ...send.file import ready
from ...send.normal_map import passing_normal_map
from ...send.properties import MapOptions
from ...send.targets import TARGETS, Options, exporter, settings, target_of
from ..process.output_files import leveled
from ..process.quiet import captured
from ..reading.load_meshes import Loaded, reason
from ..solving.cubify_all import Sculpture
from .detached import detached_copy
from .write_obj import write_obj

LEAST = 12
"""triangles of an object"""


def save_meshes(
    paths: list[Path], sculptures: list[Sculpture], loaded: Loaded, levels: list[int]
) -> list[str]:
    """Save one file per cubeness, and each level of detail of it.

    A .blend holds the whole input file with the results on its meshes, each with its original to
    restore. Formats for engines and printers hold the objects as Send writes them. All others hold
    the base meshes alone, without modifiers and shape keys, with the vertices of the input.

    `levels`: numbers of triangles of low-poly versions. Returns what should be known of the files,
    a line each. Raises InputError: a file cannot be written, or the vertices of an .obj cannot be
    told apart.
    """
    problems = []
    for number, path in enumerate(paths):
        target = target_of(path.suffix)
        kind = TARGETS[target]
        if target == "BLEND":
            _write_results(sculptures, number)
            _write(path, partial(bpy.ops.wm.save_as_mainfile, copy=True))
        elif kind.is_for_engines or kind.is_printed:
            _write_results(sculptures, number)
            users = [user for sculpture in sculptures for user in sculpture.users]
            problems += _send(path, users)
            for place, triangles in zip(leveled(path, len(levels)), levels, strict=True):
                with captured(), low_poly(sculptures, triangles, place) as (low, own):
                    problems += own + _send(place, low)
        else:
            if target == "OBJ":
                _check_rows(path, sculptures, loaded)
            with _copies(sculptures, number) as copies:
                _export(path, copies)
    return problems


def _send(path: Path, objects: list[bpy.types.Object]) -> list[str]:
    """Write objects as Send does, but with the unit of the file; return what should be known."""
    options = Options(scale=1.0)
    with refusals_of(path), ready(target_of(path.suffix), objects, options) as it:
        _write(path, lambda filepath: it.write(Path(filepath)))
    return [f"{path}: {problem}" for problem in it.problems]


def _write_results(sculptures: list[Sculpture], number: int) -> None:
    for sculpture in sculptures:
        pipeline.write(sculpture.object, sculpture.solutions[number], "MESH")


def _write(path: Path, writer: Callable[..., Any]) -> None:
    has_own_name = path.suffix.lower() == ".usdz"  # so that its layer has it, not that of our file
    with captured(), replacing(path, has_own_name) as temporary:
        try:
            writer(filepath=str(temporary.resolve()))
        except RuntimeError as error:
            message = f"{path}: cannot be written ({reason(error)})"
            raise InputError(f"{message}; choose another path or format") from error


@contextlib.contextmanager
def _copies(sculptures: list[Sculpture], number: int) -> Iterator[list[bpy.types.Object]]:
    """Give copies with the results, which have the names of their originals in the block."""
    copies = []
    renamed = []
    try:
        for sculpture in sculptures:
            shape = sculpture.shape(number)
            for user in sculpture.users:
                copy = detached_copy(user, shape, keep_modifiers=False)
                bpy.context.scene.collection.objects.link(copy)
                copies.append(copy)
                for original, twin in ((user, copy), (user.data, copy.data)):
                    name = original.name
                    original.name = uuid.uuid4().hex  # short: of a long one, the end is cut off
                    twin.name = name
                    renamed.append((original, name))
        bpy.context.view_layer.update()
        yield copies
    finally:
        for copy in copies:
            bpy.data.meshes.remove(copy.data)  # takes the object along
        for original, name in reversed(renamed):
            original.name = name


def _check_rows(path: Path, sculptures: list[Sculpture], loaded: Loaded) -> None:
    """Refuse an .obj whose vertices Blender has changed: what is written would not fit it."""
    users = [user for sculpture in sculptures for user in sculpture.users]
    if loaded.obj_layout is not None and loaded.is_whole:
        for user in users:
            if user.session_uid not in loaded.obj_layout.rows:
                message = f'{path}: Blender has changed the vertices of "{user.name}" on reading'
                raise InputError(f"{message} (invalid faces?); repair the file, or save a .blend")


def _export(path: Path, copies: list[bpy.types.Object]) -> None:
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in copies)
    target, options = target_of(path.suffix), Options(with_animation=False, suffix=path.suffix)
    chosen = settings(target, copies, options, is_modified=False)
    export = partial(exporter(target), **chosen)
    if target == "OBJ":
        _write(path, lambda filepath: write_obj(path, Path(filepath), copies, export))
    else:
        _write(path, export)


@contextlib.contextmanager
def low_poly(
    sculptures: list[Sculpture], triangles: int, path: Path
) -> Iterator[tuple[list[bpy.types.Object], list[str]]]:
    """Give low-poly versions of all objects, which carry their results, during the block.

    `triangles`: of all meshes together, shared among them by the triangles that they have. `path`:
    of the file that they are for. Gives the objects, and what should be known about them, a line
    each. Raises InputError: there is no Cycles, or a mesh has no room for another UV map.
    """
    total = sum(sculpture.member.triangles for sculpture in sculptures)
    objects: list[bpy.types.Object] = []
    problems: list[str] = []
    with contextlib.ExitStack() as passing:
        for sculpture in sculptures:
            member = sculpture.member
            share = max(LEAST, triangles * member.triangles // total)
            options = MapOptions(triangles=share)
            with refusals_of(path):
                made = passing.enter_context(
                    passing_normal_map(sculpture.object, member.alone, options)
                )
            objects.append(made.object)
            for user in sculpture.users[1:]:
                twin = user.copy()
                passing.callback(bpy.data.objects.remove, twin)
                twin.data, twin.name = made.object.data, f"{user.name} Low"
                for modifier in [m for m in twin.modifiers if m.type != "ARMATURE"]:
                    twin.modifiers.remove(modifier)  # the low-poly mesh has them
                bpy.context.scene.collection.objects.link(twin)
                objects.append(twin)
            problems += [f"{path}: {problem}" for problem in made.problems]
        bpy.context.view_layer.update()
        yield objects, problems
