# SPDX-License-Identifier: GPL-3.0-or-later
"""Save results as mesh files that have the vertices of the input, in the same order."""

import contextlib
import os
import uuid
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

from ....solver.console.errors import InputError
from ....solver.console.temporary import replacing
from ...run import pipeline
from ..process.quiet import captured
from ..reading.blender_operator import operator, reason
from ..reading.load_meshes import Loaded
from ..reading.mesh_arrays import positions_of
from ..reading.obj_layout import ObjLayout
from ..solving.cubify_all import Sculpture
from ..trust.opened import with_all_paths
from .detached import detached_copy
from .write_obj import ObjPart, write_obj

__all__ = ("check_exporter", "save_meshes")

TO_Y_UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
"""Blender's Z-up space to that of .obj files, as Blender's own exporter has it"""


def save_meshes(
    paths: list[Path],
    sculptures: list[Sculpture],
    loaded: Loaded,
    verbose: bool,
) -> None:
    """Save one file per cubeness.

    A .blend holds the whole input file with the results on its meshes, each with its original to
    restore. All other formats hold the base meshes alone, without modifiers and shape keys.

    Raises
    ------
    InputError
        A file cannot be written, or the vertices of an .obj cannot be told apart.
    """
    for number, path in enumerate(paths):
        if path.suffix.lower() == ".blend":
            _save_blend(path, sculptures, number, verbose)
            continue
        with _copies(sculptures, number) as copies:
            if path.suffix.lower() == ".obj":
                _save_obj(path, copies, loaded)
            else:
                _export(path, [copy for copy, _ in copies], verbose)


def check_exporter(path: Path) -> None:
    """Raise InputError if this Blender cannot write the format."""
    if path.suffix.lower() not in (".obj", ".blend"):
        _exporter(path)


def _save_blend(path: Path, sculptures: list[Sculpture], number: int, verbose: bool) -> None:
    for sculpture in sculptures:
        pipeline.write(sculpture.object, sculpture.solutions[number], "MESH")
    with with_all_paths():
        _write(path, partial(bpy.ops.wm.save_as_mainfile, copy=True), verbose)


def _write(path: Path, writer: Callable[..., Any], verbose: bool) -> None:
    """Have an operator of Blender write a file."""
    has_own_name = path.suffix.lower() == ".usdz"  # so that its layer has it, not that of our file
    with captured(verbose), replacing(path, has_own_name) as temporary:
        try:
            writer(filepath=str(temporary.resolve()))
        except RuntimeError as error:
            message = f"{path}: cannot be written ({reason(error)})"
            raise InputError(f"{message}; choose another path or format") from error


@contextlib.contextmanager
def _copies(
    sculptures: list[Sculpture], number: int
) -> Iterator[list[tuple[bpy.types.Object, bpy.types.Object]]]:
    """Give copies with the results, each with its original, whose name it has in the block."""
    copies = []
    renamed = []
    try:
        for sculpture in sculptures:
            shape = sculpture.shape(number)
            for user in sculpture.users:
                copy = detached_copy(user, shape, keep_modifiers=False)
                bpy.context.scene.collection.objects.link(copy)
                copies.append((copy, user))
                for original, twin in ((user, copy), (user.data, copy.data)):
                    name = original.name
                    original.name = uuid.uuid4().hex  # short: of a long one, the end is cut off
                    twin.name = name
                    renamed.append((original, name))
        bpy.context.view_layer.update()
        yield copies
    finally:
        for copy, _ in copies:
            bpy.data.meshes.remove(copy.data)  # takes the object along
        for original, name in reversed(renamed):
            original.name = name


def _save_obj(
    path: Path, copies: list[tuple[bpy.types.Object, bpy.types.Object]], loaded: Loaded
) -> None:
    layout, library = loaded.obj_layout, ""
    is_as_in_file = layout is not None and loaded.is_whole
    parts, count = [], 0
    for copy, original in copies:
        rows = np.arange(count, count + len(copy.data.vertices))
        count += len(rows)
        if is_as_in_file:
            rows = _rows_in_file(path, layout, original.session_uid, copy.name)
        parts.append(ObjPart(copy.name, copy.data, _placed_positions(copy), rows))
    positions = layout.positions if is_as_in_file else np.zeros((count, 3), np.float32)
    if layout is not None and layout.library is not None:
        library = _relative(layout.library, path.parent)
    offset, encoding = (layout.offset, layout.encoding) if layout else (np.zeros(3), "utf-8")
    with replacing(path) as temporary:
        write_obj(temporary, parts, positions, library, offset, encoding)


def _rows_in_file(path: Path, layout: ObjLayout, uid: int, name: str) -> np.ndarray:
    if uid not in layout.rows:
        message = f'{path}: Blender has changed the vertices of "{name}" on reading'
        raise InputError(f"{message} (invalid faces?); repair the file, or save a .blend")
    return layout.rows[uid]


def _relative(target: Path, folder: Path) -> str:
    """Path of the target as seen from the folder, with forward slashes."""
    try:
        return Path(os.path.relpath(target.resolve(), folder.resolve())).as_posix()
    except ValueError:  # on another drive
        return target.resolve().as_posix()


def _placed_positions(copy: bpy.types.Object) -> np.ndarray:
    """Return (n,3) positions in the space of an .obj; if one was read, bit for bit as in it."""
    positions = positions_of(copy.data)
    to_file = np.array(TO_Y_UP @ copy.matrix_world)
    if np.allclose(to_file, np.eye(4), rtol=0.0, atol=1e-6):
        return positions
    return positions.astype(np.float64) @ to_file[:3, :3].T + to_file[:3, 3]


def _export(path: Path, copies: list[bpy.types.Object], verbose: bool) -> None:
    """Run Blender's exporter for the copies, and for them only."""
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in copies)
    _write(path, _exporter(path), verbose)


def _exporter(path: Path) -> Callable[..., Any]:
    return _EXPORTERS[path.suffix.lower()](path)


def _ply_exporter(path: Path) -> Callable[..., Any]:
    # A .ply knows one UV per vertex: seams would split vertices.
    options = {"export_selected_objects": True, "apply_modifiers": False, "export_uv": False}
    return partial(operator("wm.ply_export", path), **options)


def _alembic_exporter(path: Path) -> Callable[..., Any]:
    return partial(operator("wm.alembic_export", path), selected=True, start=1, end=1)


def _usd_exporter(path: Path) -> Callable[..., Any]:
    usd_export: Any = operator("wm.usd_export", path)
    wanted = {"convert_world_material": False}
    if path.suffix.lower() != ".usdz":
        wanted |= {"export_textures_mode": "KEEP"}  # no folder of textures beside the file
    known = usd_export.get_rna_type().properties
    options = {name: value for name, value in wanted.items() if name in known}
    return partial(usd_export, selected_objects_only=True, **options)


_EXPORTERS = {
    ".ply": _ply_exporter,
    ".abc": _alembic_exporter,
    **dict.fromkeys((".usd", ".usdc", ".usda", ".usdz"), _usd_exporter),
}
"""by the suffix of the file, but for .obj and .blend"""
