# SPDX-License-Identifier: GPL-3.0-or-later
"""The pipeline of one object: mesh bridge -> solver -> mesh bridge.

`prepare` and `solve` change nothing, so that an exception or a cancel loses nothing; `write` does.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Callable
from dataclasses import dataclass

import bpy
import numpy as np

from .. import solver
from . import handles, mesh_bridge
from .kernel_cache import use_extension_folder
from .object_frame import stretch_and_orientation
from .requirements import check_requirements
from .settings import Settings


@dataclass(frozen=True)
class Shape:
    """What is read once from a mesh: the original shape and its virtual triangulation."""

    original: np.ndarray
    """(n,3) float32 positions, object space"""
    triangles: np.ndarray
    """(m,3) int"""

    def is_like(self, other: Shape) -> bool:
        """Tell whether both are the same, bit for bit."""
        is_same = self.original.tobytes() == other.original.tobytes()
        return is_same and np.array_equal(self.triangles, other.triangles)


@dataclass(frozen=True)
class Prepared:
    """What is done once per mesh, scale and handles."""

    name: str
    shape: Shape
    settings: Settings
    stretch: np.ndarray
    orientation: np.ndarray
    setup: solver.Setup
    handle_of: np.ndarray
    """(n,) int, the number of the handle that holds each vertex, or -1"""
    map_weights: np.ndarray | float
    """(n,) factors of the cubeness, or 1"""
    seconds: float

    @property
    def vertices(self):
        """Number of vertices."""
        return len(self.shape.original)

    @property
    def triangles(self):
        """Number of triangles of the virtual triangulation."""
        return len(self.setup.rest.F)

    @property
    def components(self):
        """Number of connected parts, loose vertices not counted."""
        return self.setup.rest.component_count


@dataclass(frozen=True)
class Solution:
    """A result that has not been written yet."""

    positions: np.ndarray
    """(n,3) float32, object space"""
    rotations: np.ndarray
    """(n,3,3) float64 rotations of the vertices' surroundings, object space"""
    result: solver.Result
    setup_seconds: float

    @property
    def seconds(self):
        """Time of the iterations."""
        return self.result.solve_seconds

    @property
    def total_seconds(self):
        """Time that the artist has waited for it."""
        return self.setup_seconds + self.seconds + self.result.compile_seconds


def prepare(
    obj: bpy.types.Object,
    settings: Settings,
    earlier: Prepared | None = None,
    *,
    weights_changed: bool = False,
) -> Prepared:
    """Read and check the object, and factorise.

    Parameters
    ----------
    obj, settings
    earlier : Prepared, optional
        Of the same object: what has not changed since is taken from it. The shape never has.
    weights_changed : bool
        The weights of vertex groups may have.

    Raises
    ------
    CubicCraftError
        The object or a setting cannot be used; the message names the object and the cure.
    """
    begin = time.perf_counter()
    stretch, orientation = stretch_and_orientation(obj, settings)
    shape = earlier.shape if earlier else read_shape(obj)
    known = None if weights_changed else earlier
    handle_of = _handle_of(obj, settings, known)
    map_weights = _map_weights(obj, settings, known)
    if earlier and np.array_equal(earlier.stretch, stretch):
        setup = earlier.setup
        if not np.array_equal(earlier.handle_of >= 0, handle_of >= 0):
            setup = _setup(obj, setup.rest, handle_of)
    else:
        setup = _setup(obj, stretched_rest(obj, shape, stretch), handle_of)
    return Prepared(
        obj.name,
        shape,
        settings,
        stretch,
        orientation,
        setup,
        handle_of,
        map_weights,
        time.perf_counter() - begin,
    )


def read_shape(obj: bpy.types.Object) -> Shape:
    """Read the original shape of an object.

    Raises
    ------
    CubicCraftError
        The object cannot be used; the message names it and the cure.
    """
    check_requirements()
    mesh_bridge.check_editable(obj)
    mesh = mesh_bridge.mesh_of(obj)
    original = mesh_bridge.original_positions(mesh)
    return Shape(original, mesh_bridge.triangles(mesh, original))


def stretched_rest(obj: bpy.types.Object, shape: Shape, stretch):
    """Build the RestMesh of the shape as it is seen.

    Raises
    ------
    CubicCraftError
        The shape cannot be used; the message names the object and the cure.
    """
    positions = shape.original.astype(np.float64) @ stretch.T
    try:
        return solver.rest_mesh(positions, shape.triangles)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{obj.name}": {error}') from error


def _setup(obj, rest, handle_of):
    try:
        return solver.Setup(rest, np.flatnonzero(handle_of >= 0))
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{obj.name}": {error}') from error


def start(prepared: Prepared, settings: Settings) -> solver.Run:
    """Start a run from the original shape.

    Raises
    ------
    CubicCraftError
        A setting cannot be used, or the device is not there.
    """
    use_extension_folder()
    targets = handles.targets(prepared.shape.original, prepared.handle_of, settings.handles)
    try:
        stylization = solver.Stylization(
            prepared.setup,
            settings.cubeness * prepared.map_weights,
            prepared.orientation,
            targets @ prepared.stretch.T,
            device=settings.device.lower(),
            keep_rotation=_keeps_rotation(prepared, settings),
        )
        return solver.Run(stylization, settings.max_iterations, settings.tolerance)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{prepared.name}": {error}') from error


def solve(
    prepared: Prepared,
    settings: Settings,
    on_iteration: Callable[[solver.Stylization], bool] | None = None,
) -> Solution:
    """Run to the end; `on_iteration` is called after each iteration, a true value cancels the run.

    Raises
    ------
    CubicCraftError
        As `start`, and where what the run had on a GPU is lost.
    """
    run = start(prepared, settings)
    try:
        run.complete(on_iteration)
        return solution_of(prepared, run)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{prepared.name}": {error}') from error


def glance(prepared: Prepared, run: solver.Run, with_rotations: bool):
    """Return positions and rotations, as in a Solution, that a run has come to so far.

    The rotations take time, and are None unless they are asked for.
    """
    if not with_rotations:
        return _unstretched_positions(prepared, run.positions()), None
    positions, rotations = run.placed()
    positions = _unstretched_positions(prepared, positions)
    return positions, _unstretched(rotations, prepared.stretch)


def solution_of(prepared: Prepared, run: solver.Run) -> Solution:
    """Return what a run has come to; it cannot go on after that."""
    result = run.result()
    positions = _unstretched_positions(prepared, result.positions)
    rotations = _unstretched(result.rotations, prepared.stretch)
    return Solution(positions, rotations, result, prepared.seconds)


def write(
    obj: bpy.types.Object,
    solution: Solution,
    result: str,
    remember: Callable[[bpy.types.Object], None] = lambda target: None,
) -> bpy.types.Object:
    """Write a Solution to the object's mesh, to a shape key of it, or to a new object.

    Parameters
    ----------
    result : {"MESH", "SHAPE_KEY", "NEW_OBJECT"}
    remember : callable
        Called with the object that gets the cubic shape, before the step that cannot be taken back:
        if it raises, or what follows, all meshes and objects are as they were before. What it has
        done to the settings of an object that was there is for the caller to put back.

    Returns
    -------
    bpy.types.Object
        The object that now has the cubic shape.
    """
    if result == "NEW_OBJECT":
        return mesh_bridge.write_new_object(obj, solution.positions, solution.rotations, remember)
    remember(obj)
    if result == "SHAPE_KEY":
        mesh_bridge.write_shape_key(obj, solution.positions)
    else:
        mesh_bridge.write_mesh(mesh_bridge.mesh_of(obj), solution.positions, solution.rotations)
    return obj


def _handle_of(obj, settings, known):
    groups = [handle.members for handle in settings.handles]
    if known and groups == [handle.members for handle in known.settings.handles]:
        return known.handle_of
    return handles.handle_of(obj, settings.handles)


def _map_weights(obj, settings, known):
    if not settings.map_group:
        return 1.0
    choice = (settings.map_group, settings.map_invert)
    if known and choice == (known.settings.map_group, known.settings.map_invert):
        return known.map_weights
    weights = mesh_bridge.group_weights(obj, settings.map_group)
    return 1.0 - weights if settings.map_invert else weights


def _unstretched_positions(prepared, stretched):
    positions = (stretched @ np.linalg.inv(prepared.stretch).T).astype(np.float32)
    # What the solver holds must not move by a rounding of the stretch.
    is_still = (stretched == prepared.setup.rest.input_positions).all(axis=1)
    positions[is_still] = prepared.shape.original[is_still]
    return positions


def _keeps_rotation(prepared, settings):
    """Tell whether each free part is held in its orientation.

    A part may turn by some degrees to fit the cube. Several parts would each turn their own way and
    come apart, such as eyes from their sockets; a single one gets a lower energy when it is free.
    """
    return settings.rotation == "KEEP" or (settings.rotation == "AUTO" and prepared.components > 1)


def _unstretched(rotations, stretch):
    """Return the rotations (n,3,3) in object space.

    On an object that is scaled unevenly they are the nearest rotations to what happens to a
    vertex's surroundings; they turn the offsets of shape keys, and must not distort them.
    """
    if np.allclose(stretch, stretch[0, 0] * np.eye(3), rtol=1e-6, atol=0.0):
        return rotations
    maps = np.linalg.inv(stretch) @ rotations @ stretch
    return solver.svd_rotations(maps.swapaxes(1, 2))
