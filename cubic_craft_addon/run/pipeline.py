# SPDX-License-Identifier: GPL-3.0-or-later
"""A problem from objects in Blender: solved, and its solutions written.

`solve` changes nothing, so that an exception or a cancellation loses nothing; only `write` makes
changes.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import bpy
import numpy as np

from ... import solver
from ...solver.pieces.piece import is_stiff, parts_of
from ...solver.pieces.problem import Problem, join_pieces
from .. import mesh_bridge
from ..environment.kernel_cache import use_extension_folder
from ..read.member import Member, placed
from ..settings.values import Settings

if TYPE_CHECKING:
    from ...solver.aliases import Device

MemberProblem: TypeAlias = Problem[Member]


@dataclass(frozen=True)
class Solution:
    """A result for one object that has not been written yet."""

    positions: np.ndarray
    """(n,3) float32, object space"""
    rotations: np.ndarray
    """(n,3,3) float64 rotations of the vertices' surroundings, object space"""
    result: solver.Result
    """of all objects that were solved with it"""
    setup_seconds: float
    vertices: int
    """number of vertices of all objects that were solved together"""
    objects: int = 1
    """number of objects that were solved together, including this one"""
    matching: int | None = None
    """number of vertices that have a mirror image, with Symmetry"""
    start: mesh_bridge.Start = "HERE"
    """which shape was solved if the mesh was edited by hand since its last result"""
    is_stiff: bool = False
    """whether it is a cage of too few vertices to follow"""

    @property
    def own_vertices(self):
        """Number of vertices of the object."""
        return len(self.positions)

    @property
    def seconds(self):
        """Time of the iterations."""
        return self.result.solve_seconds

    @property
    def total_seconds(self):
        """Time that the artist has waited."""
        return self.setup_seconds + self.seconds + self.result.compile_seconds


def prepare(members: Sequence[Member], earlier: Sequence[MemberProblem] = ()) -> MemberProblem:
    """Join the members of an assembly, and factorize them.

    `members`: a single member is solved in its own coordinates, several in world space. `earlier`:
    unchanged data is reused. Raises CubicCraftError: they cannot be solved; the message names the
    objects.
    """
    settings, keep = members[0].settings, len(members) > 1 and members[0].settings.keep_symmetric
    return join_pieces(placed(members), settings.proxy, earlier, keep_symmetric=keep)


def settings_of_all(problem: MemberProblem) -> Settings:
    """Return the settings of the first member, for those that all share."""
    return problem.pieces[0].settings


def with_cubeness(problem: MemberProblem, cubeness: float) -> MemberProblem:
    """Return the same with another cubeness."""
    members = tuple(member.with_cubeness(cubeness) for member in problem.pieces)
    return replace(problem, pieces=members)


def start(problem: MemberProblem) -> solver.Run:
    """Start a run from the original shapes, with the settings of the members.

    Raises CubicCraftError: a setting is invalid, or the device is not available.
    """
    settings = settings_of_all(problem)
    try:
        stylization = stylization_of(problem)
        return solver.Run(stylization, settings.max_iterations, settings.tolerance)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f"{problem.name}: {error}") from error


def go_on(problem: MemberProblem, run: solver.Run) -> solver.Run:
    """Return a Run that goes on from the present shape of another in a pose of the same objects.

    `problem`: from `Problem.posed`, of what the other run was made for. Raises CubicCraftError: as
    `start`, without the name.
    """
    from ...solver.iteration.restyled_run import RestyledRun, has_sides

    settings = settings_of_all(problem)
    stylization = run.soft.moved(problem.setup, problem.pose_of_handles)
    if has_sides(run):
        return RestyledRun(run, stylization, keeps_sides=False)
    return solver.Run(stylization, settings.max_iterations, settings.tolerance, keep_apart=False)


def restyled(
    problem: MemberProblem, before: MemberProblem, run: solver.Run, *, keeps_sides: bool
) -> solver.Run | None:
    """Return a Run that goes on from another, of the problem `before`, with the settings of this.

    `keeps_sides`: as of `RestyledRun`. None if that has no sides yet, the problem is to have none,
    or other vertices are solved. Raises CubicCraftError: as `start`, without the name.
    """
    from ...solver.iteration.restyled_run import RestyledRun, has_sides

    rest, known = problem.setup.rest, run.soft.rest
    is_like = rest.V is known.V and rest.topology.F is known.topology.F
    if not (is_like and has_sides(run) and np.any(problem.style.crispness)):
        return None
    soft = stylization_of(problem)
    soft.go_on_from(run.soft, run.soft.setup if problem.setup is before.setup else problem.setup)
    return RestyledRun(run, soft, keeps_sides=keeps_sides)


def stylization_of(problem: MemberProblem) -> solver.Stylization:
    """Return a new Stylization with the settings of the members.

    Raises CubicCraftError: as `start`, without the name.
    """
    use_extension_folder()
    settings = settings_of_all(problem)
    options = solver.SolverOptions(
        device=cast("Device", settings.device.lower()),
        keep_rotation=settings.rotation == "KEEP",
    )
    return problem.stylization(options)


def solve(
    problem: MemberProblem, on_iteration: Callable[[solver.Stylization], bool] | None = None
) -> tuple[Solution, ...]:
    """Run to the end, and return a Solution for each member.

    `on_iteration` is called after each iteration, a true value cancels the run.

    Raises CubicCraftError: as `start`, and if the data of the run on a GPU is lost.
    """
    run = start(problem)
    try:
        run.complete(on_iteration)
        return solutions_of(problem, run.result())
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f"{problem.name}: {error}") from error


def solutions_of(problem: MemberProblem, result: solver.Result) -> tuple[Solution, ...]:
    """Return the Result of a run as a Solution for each member."""
    found = read_back(problem, result.positions, result.rotations)
    return tuple(
        Solution(
            positions,
            rotations,
            result,
            problem.seconds,
            problem.vertices,
            len(problem.pieces),
            member.whole.matching,
            member.shape.start,
            is_stiff(member, result.positions[part], positions),
        )
        for (member, part), (positions, rotations) in zip(
            parts_of(problem.pieces), found, strict=True
        )
    )


def write(
    obj: bpy.types.Object,
    solution: Solution,
    result: str,
    complete: Callable[[bpy.types.Object], None] = lambda target: None,
    run: dict[str, Any] | None = None,
) -> bpy.types.Object:
    """Write a Solution to the object's mesh, to a shape key of it, or to a new object.

    `result`: {"MESH", "SHAPE_KEY", "NEW_OBJECT"}. `complete`: called with the object that has got
    the cubic shape, before the step that cannot be undone: if it or anything later raises, all
    meshes and objects are as they were before. The caller must restore the settings of an existing
    object that it has changed. `run`: dict, optional, the note for the mesh, a `LastRun`. Returns
    the object that now has the shape.
    """
    made = solution.positions, solution.rotations
    if result == "NEW_OBJECT":
        return mesh_bridge.write_new_object(obj, *made, complete, run, solution.start)
    noted = run, solution.start, partial(complete, obj)
    if result == "SHAPE_KEY":
        mesh_bridge.write_shape_key(obj, *made, *noted)
    else:
        mesh_bridge.write_mesh(mesh_bridge.mesh_of(obj), *made, *noted)
    return obj


def shape_of(obj: bpy.types.Object, solution: Solution) -> np.ndarray:
    """Return the positions (n,3) that writing a Solution would give the object's mesh."""
    return mesh_bridge.positions_with_strokes(
        mesh_bridge.mesh_of(obj), solution.positions, solution.rotations, solution.start
    )


def read_back(problem: MemberProblem, positions, rotations):
    """Return the results of the solver, for each member in its object's coordinates."""
    settings = settings_of_all(problem)
    stands = settings.floor == "AUTO" and settings.rotation == "KEEP"
    return problem.split(
        positions, rotations, keep_floor=stands or settings.floor == "ON", only_standing=stands
    )
