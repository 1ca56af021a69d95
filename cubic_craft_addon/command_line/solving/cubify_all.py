# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify every mesh at every cubeness; nothing is written to any mesh here."""

import math
from argparse import Namespace
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

from ....solver import Progress
from ....solver.console.method_options import settings_from
from ....solver.console.output import InputError
from ....solver.console.run_words import end_words
from ....solver.method import Method
from ... import mesh_bridge
from ...handles import Handle
from ...mesh_bridge import read_position
from ...read.member import Member, assemblies, read_member
from ...regions.region import Region
from ...run.pipeline import (
    MemberProblem,
    Solution,
    prepare,
    settings_of_all,
    shape_of,
    solve,
    with_cubeness,
)
from ...settings.values import Settings
from ..options.formats import RENUMBER_VERTICES
from ..options.handles_file import GivenHandle
from ..options.region_option import region_of
from ..process.progress import task
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


@dataclass
class Sculpture:
    """One mesh, the objects that show it, and its cubic versions."""

    users: list[bpy.types.Object]
    """the first of them was solved"""
    member: Member
    problem: MemberProblem
    """all that was solved at once with it"""
    solutions: list[Solution]
    """one per cubeness"""

    @property
    def object(self) -> bpy.types.Object:
        """The object that was solved."""
        return self.users[0]

    def shape(self, number: int) -> np.ndarray:
        """Return the positions (n,3) of a cubic version, as a .blend would have them."""
        return shape_of(self.object, self.solutions[number])


def cubify_all(loaded: Loaded, options: Namespace) -> list[Sculpture]:
    """Solve each mesh once per cubeness; objects that share a mesh share the results.

    Raises InputError: no object has a vertex group that was named, or a handle concerns none;
    CubicCraftError: an object, or an option for it, cannot be used.
    """
    check_groups(loaded.objects, options)
    handles = handles_of_all(loaded, options)
    by_mesh: dict[str, list[bpy.types.Object]] = {}
    for obj in loaded.objects:
        by_mesh.setdefault(obj.data.name_full, []).append(obj)
    members = [
        read_member(users[0], settings_of_object(users[0], handles[users[0].name], options, loaded))
        for users in by_mesh.values()
    ]
    # All checks of all objects come first, so that a refusal costs no solve.
    problems = [prepare(group) for group in assemblies(members)]
    found = {}
    for problem in problems:
        solutions = [_solve(with_cubeness(problem, value)) for value in options.cubeness]
        for member, own in zip(problem.pieces, zip(*solutions, strict=True), strict=True):
            found[member.uid] = (member, problem, list(own))
    return [Sculpture(users, *found[users[0].session_uid]) for users in by_mesh.values()]


def _solve(problem: MemberProblem) -> tuple[Solution, ...]:
    settings, members = settings_of_all(problem), problem.pieces
    progress = Progress(settings.max_iterations, settings.tolerance)
    name = members[0].name if len(members) == 1 else f"{len(members)} objects together"
    with task(f"{name}, cubeness {settings.cubeness!r}") as shown:
        solutions = solve(problem, lambda state: shown.show(f"{progress.update(state):.0%}"))
        shown.summary = _summary(solutions[0])
    return solutions


def settings_of_object(
    obj: bpy.types.Object, handles: tuple[Handle, ...], options: Namespace, loaded: Loaded
) -> Settings:
    """Return the Settings for one object; a group that only others have does not concern it."""
    values = settings_from(vars(options), Method)
    for name in ("map_group", "detail_group"):
        values[name] = values[name] if values[name] in obj.vertex_groups else ""
    return Settings(
        **{**values, "cubeness": options.cubeness[0]},
        form_object=loaded.form,
        handles=handles,
        regions=_regions(obj, options),
        start=start_of(obj),
        symmetry=tuple(options.symmetry != "auto" and axis in options.symmetry for axis in "xyz"),
        keep_symmetric=options.symmetry == "auto",
    )


def _regions(obj: bpy.types.Object, options: Namespace) -> tuple[Region, ...]:
    return tuple(
        Region(
            group=region.group,
            cubeness=region.cubeness,
            form=region.form.upper(),
            form_sides=region.sides,
            orientation=tuple(math.radians(angle) for angle in options.orientation),
        )
        for region in map(region_of, options.region)
        if region.group in obj.vertex_groups
    )


def check_groups(objects: list[bpy.types.Object], options: Namespace) -> None:
    """Raise InputError if no object has a vertex group that was named."""
    there, has = groups_of(objects)
    wanted = [("--pin", group) for group in options.pin]
    wanted += [("--region", region_of(text).group) for text in options.region]
    named = (("--map", options.map), ("--detail-map", options.detail_map))
    wanted += [pair for pair in named if pair[1]]
    for option, group in wanted:
        if group not in there:
            raise InputError(f"{option} {group}: no such vertex group; the input has {has}")


def _summary(solution: Solution) -> str:
    result = solution.result
    end = end_words("converged" if result.converged else "not converged", result)
    return (
        f"{result.iterations} iterations, {end}, energy {result.energy.total:.4g}, "
        f"{solution.seconds:.1f} s on {result.device}"
    )
