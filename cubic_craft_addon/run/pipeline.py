# SPDX-License-Identifier: GPL-3.0-or-later
"""The pipeline of an assembly: mesh bridge -> solver -> mesh bridge.

`assembly.prepare` and `solve` change nothing, so that an exception or a cancellation loses nothing;
only `write` makes changes.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import bpy
import numpy as np

from ... import solver
from .. import mesh_bridge
from ..environment.kernel_cache import use_extension_folder
from .assembly import Prepared
from .fields import known_limbs, styles, targets
from .floor import kept_on_floor
from .normal_capture import captures

if TYPE_CHECKING:
    from ...solver.aliases import Device


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


def start(prepared: Prepared) -> solver.Run:
    """Start a run from the original shapes, with the settings of the members.

    Raises
    ------
    CubicCraftError
        A setting is invalid, or the device is not available.
    """
    settings = prepared.settings
    try:
        stylization = stylization_of(prepared)
        return solver.Run(stylization, settings.max_iterations, settings.tolerance)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f"{prepared.name}: {error}") from error


def go_on(prepared: Prepared, run: solver.Run) -> solver.Run:
    """Return a Run that goes on from the present shape of another in a pose of the same objects.

    Parameters
    ----------
    prepared : Prepared
        From `Prepared.posed`, of what the other run was made for.
    run : Run

    Raises
    ------
    CubicCraftError
        As `start`, without the name.
    """
    settings = prepared.settings
    stylization = run.stylization.moved(
        prepared.setup, targets(prepared), [hold.matrix for hold in prepared.holds]
    )
    return solver.Run(stylization, settings.max_iterations, settings.tolerance, keep_apart=False)


def stylization_of(prepared: Prepared, *, is_accelerated: bool = True) -> solver.Stylization:
    """Return a new Stylization with the settings of the members.

    Raises
    ------
    CubicCraftError
        As `start`, without the name.
    """
    use_extension_folder()
    settings = prepared.settings
    style = styles(prepared)
    return solver.Stylization(
        prepared.setup,
        style.cubeness,
        style.orientation,
        targets(prepared),
        style.form,
        style.form_of,
        device=cast("Device", settings.device.lower()),
        keep_rotation=settings.rotation == "KEEP",
        hold_matrices=[hold.matrix for hold in prepared.holds],
        is_accelerated=is_accelerated,
        limbs=known_limbs(prepared),
        **captures(prepared),
    )


def solve(
    prepared: Prepared, on_iteration: Callable[[solver.Stylization], bool] | None = None
) -> tuple[Solution, ...]:
    """Run to the end, and return a Solution for each member.

    `on_iteration` is called after each iteration, a true value cancels the run.

    Raises
    ------
    CubicCraftError
        As `start`, and if the data of the run on a GPU is lost.
    """
    run = start(prepared)
    try:
        run.complete(on_iteration)
        return solutions_of(prepared, run)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f"{prepared.name}: {error}") from error


def intermediate_result(prepared: Prepared, run: solver.Run, with_rotations: bool):
    """Return the current positions and rotations of a run, as in a Solution.

    One pair per member. The rotations take time, and are None unless requested.
    """
    if with_rotations:
        return read_back(prepared, *run.placed())
    return read_back(prepared, run.positions(), None)


def solutions_of(prepared: Prepared, run: solver.Run) -> tuple[Solution, ...]:
    """Return a Solution for each member; the run cannot be continued afterwards."""
    return _solutions(prepared, run.result())


def solutions_so_far(prepared: Prepared, run: solver.Run) -> tuple[Solution, ...]:
    """Return the current shape as a Solution for each member; empty before the first iteration."""
    result = run.so_far()
    return () if result is None else _solutions(prepared, result)


def _solutions(prepared, result):
    found = read_back(prepared, result.positions, result.rotations)
    return tuple(
        Solution(
            positions,
            rotations,
            result,
            prepared.seconds,
            prepared.vertices,
            len(prepared.members),
            member.whole.matching,
            member.shape.start,
        )
        for member, (positions, rotations) in zip(prepared.members, found, strict=True)
    )


def write(
    obj: bpy.types.Object,
    solution: Solution,
    result: str,
    remember: Callable[[bpy.types.Object], None] = lambda target: None,
    run: dict[str, Any] | None = None,
) -> bpy.types.Object:
    """Write a Solution to the object's mesh, to a shape key of it, or to a new object.

    Parameters
    ----------
    result : {"MESH", "SHAPE_KEY", "NEW_OBJECT"}
    remember : callable
        Called with the object that gets the cubic shape, before the step that cannot be undone:
        if it or anything later raises, all meshes and objects are as they were before. The caller
        must restore the settings of an existing object that it has changed.
    run : dict, optional
        The note for the mesh, a `LastRun`.

    Returns
    -------
    bpy.types.Object
        The object that now has the cubic shape.
    """
    if result == "NEW_OBJECT":
        return mesh_bridge.write_new_object(
            obj, solution.positions, solution.rotations, remember, run, solution.start
        )
    remember(obj)
    if result == "SHAPE_KEY":
        mesh_bridge.write_shape_key(
            obj, solution.positions, solution.rotations, run, solution.start
        )
    else:
        mesh = mesh_bridge.mesh_of(obj)
        mesh_bridge.write_mesh(mesh, solution.positions, solution.rotations, run, solution.start)
    return obj


def shape_of(obj: bpy.types.Object, solution: Solution) -> np.ndarray:
    """Return the positions (n,3) that writing a Solution would give the object's mesh."""
    return mesh_bridge.positions_with_strokes(
        mesh_bridge.mesh_of(obj), solution.positions, solution.rotations, solution.start
    )


def read_back(prepared, positions, rotations):
    """Return the results of the solver, for each member in its object's coordinates."""
    at_rest = prepared.setup.rest.input_positions
    if prepared.settings.floor:
        positions = kept_on_floor(prepared.setup, positions, prepared.placements[0].up)
    is_held = np.zeros(len(at_rest), dtype=bool)
    is_held[prepared.setup.pinned_input] = True
    found = []
    for member, placement, whole_part in prepared.parts():
        part = slice(whole_part.start, whole_part.start + member.vertices)
        own = placement.read_back(positions[part]).astype(np.float32)
        # Held vertices must not move by rounding errors of the placement.
        is_still = (positions[part] == at_rest[part]).all(axis=1) | prepared.is_idle
        own[is_still] = member.shape.original[is_still]
        turned = None if rotations is None else placement.read_rotations_back(rotations[part])
        member.whole.symmetrize(own, is_held[part] | is_still)
        if turned is not None:
            member.whole.settle_rotations(turned, is_held[part])
        found.append((own, turned))
    return found
