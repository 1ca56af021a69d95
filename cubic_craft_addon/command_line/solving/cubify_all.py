# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify every mesh at every cubeness; nothing is written to any mesh here."""

import math
from argparse import Namespace
from dataclasses import dataclass

import bpy
import numpy as np

from ....solver import Progress
from ....solver.console.crossing_words import end_words
from ....solver.console.errors import InputError
from ....solver.console.method_options import settings_from
from ....solver.method import Method
from ...handles import Handle
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
from ..options.region_option import region_of
from ..process.progress import ProgressBar
from ..reading.load_meshes import Loaded
from .pose import groups_of, handles_of_all, start_of


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


def cubify_all(loaded: Loaded, options: Namespace, bar: ProgressBar) -> list[Sculpture]:
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
        solutions = [_solve(with_cubeness(problem, value), bar) for value in options.cubeness]
        for member, own in zip(problem.pieces, zip(*solutions, strict=True), strict=True):
            found[member.uid] = (member, problem, list(own))
    return [Sculpture(users, *found[users[0].session_uid]) for users in by_mesh.values()]


def _solve(problem: MemberProblem, bar: ProgressBar) -> tuple[Solution, ...]:
    """Return the Solution of each member."""
    settings, members = settings_of_all(problem), problem.pieces
    progress = Progress(settings.max_iterations, settings.tolerance)
    name = members[0].name if len(members) == 1 else f"{len(members)} objects together"
    with bar.task(f"{name}, cubeness {settings.cubeness!r}") as task:
        solutions = solve(problem, lambda state: task.advance_to(progress.update(state)))
        task.finish(_summary(solutions[0]))
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
        capture_object=loaded.capture,
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
