# SPDX-License-Identifier: GPL-3.0-or-later
"""From the handles of the command line to those of each object."""

import math
from argparse import Namespace

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

from ....solver.console.errors import InputError
from ... import mesh_bridge
from ...handles import Handle
from ...mesh_bridge import read_position
from ..options.formats import RENUMBER_VERTICES
from ..options.handles_file import GivenHandle
from ..reading.load_meshes import Loaded


def groups_of(objects: list[bpy.types.Object]) -> tuple[list[str], str]:
    """Return the names of all vertex groups, and the same for a message."""
    there = list(dict.fromkeys(group.name for obj in objects for group in obj.vertex_groups))
    return there, ", ".join(f'"{name}"' for name in there) or "no vertex group at all"


def start_of(obj: bpy.types.Object) -> str:
    """Return what a mesh starts from that was edited since it was cubified: what the file says."""
    # Before Blender 5, reading the settings stores them on the object.
    return obj.cubic_craft.start if obj.is_property_set("cubic_craft") else "EDITS"


def handles_of_all(loaded: Loaded, options: Namespace) -> dict[str, tuple[Handle, ...]]:
    """Return the handles of each object, by its name.

    Those of ``--pin`` come first, so they hold where others overlap them. A handle that only other
    objects have does not concern an object.

    Raises InputError: a handle of the file concerns no object, or its vertex numbers mean nothing
    here.
    """
    found: dict[str, list[Handle]] = {
        obj.name: [Handle(group) for group in options.pin if group in obj.vertex_groups]
        for obj in loaded.objects
    }
    for given in options.handles:
        is_anywhere = False
        for obj in loaded.objects:
            original = mesh_bridge.original_positions(obj.data, start_of(obj))
            members = _members(obj, original, given, loaded, options)
            if len(members):
                is_anywhere = True
                matrix = _matrix(given, original[members].astype(np.float64))
                handle = Handle(
                    vertices=tuple(members.tolist()), matrix=matrix, is_cubic=given.cubic
                )
                found[obj.name].append(handle)
        if not is_anywhere:
            raise InputError(f"{given.where}: {_why_nothing(given, loaded)}")
    return {name: tuple(handles) for name, handles in found.items()}


def _members(
    obj: bpy.types.Object,
    original: np.ndarray,
    given: GivenHandle,
    loaded: Loaded,
    options: Namespace,
) -> np.ndarray:
    """Return the vertices (k,) int of the object that belong to the handle."""
    if given.group is not None:
        if given.group not in obj.vertex_groups:
            return np.empty(0, np.int64)
        weights = mesh_bridge.group_weights(obj, given.group)
        return np.flatnonzero(weights >= given.threshold)
    if given.box is not None:
        low, high = np.array(given.box)
        return np.flatnonzero(((original >= low) & (original <= high)).all(axis=1))
    assert given.vertices is not None
    numbers = _numbers_in_file(obj, len(original), given, loaded, options)
    return np.flatnonzero(np.isin(numbers, given.vertices))


def _numbers_in_file(
    obj: bpy.types.Object, count: int, given: GivenHandle, loaded: Loaded, options: Namespace
) -> np.ndarray:
    """Return the number (n,) int that each vertex has in the input file."""
    assert given.vertices is not None
    suffix = options.input.suffix.lower() if options.input is not None else ""
    if suffix in RENUMBER_VERTICES:
        raise InputError(
            f"{given.where}: {suffix} files do not keep the numbers of vertices; give a box"
        )
    rows = loaded.obj_layout.rows.get(obj.session_uid) if loaded.obj_layout is not None else None
    if rows is not None:
        count = len(loaded.obj_layout.positions)
    elif len(loaded.objects) > 1:
        raise InputError(
            f"{given.where}: the input has {len(loaded.objects)} meshes, each with vertices of its"
            " own; choose one by --object, or give a group or a box"
        )
    if max(given.vertices) >= count:
        raise InputError(
            f"{given.where}: there is no vertex {max(given.vertices)}; the last is {count - 1}"
        )
    return np.arange(count) if rows is None else rows


def _matrix(given: GivenHandle, held: np.ndarray) -> tuple[float, ...]:
    """Return the map of the handle as 16 numbers, row by row."""
    pivot = Vector(given.pivot or (held.min(axis=0) + held.max(axis=0)) / 2)
    turn = Euler([math.radians(angle) for angle in given.rotate])
    place = Matrix.LocRotScale(pivot + Vector(given.translate), turn, given.scale)
    matrix = np.array(place @ Matrix.Translation(-pivot), dtype=np.float64)
    return tuple((matrix + 0.0).ravel().tolist())  # no -0.0, which would be no identity


def _why_nothing(given: GivenHandle, loaded: Loaded) -> str:
    if given.vertices is not None:
        return "none of its vertices is part of the mesh"
    if given.box is not None:
        points = np.concatenate([read_position(obj.data) for obj in loaded.objects], dtype=float)
        low, high = (np.round(f(axis=0), 6).tolist() for f in (points.min, points.max))
        return f"no vertex lies in its box; the input extends from {low} to {high}"
    there, has = groups_of(loaded.objects)
    if given.group in there:
        return (
            f'no vertex weighs {given.threshold:g} or more in the vertex group "{given.group}";'
            " lower the threshold"
        )
    return f"no such vertex group: {given.group}; the input has {has}"
