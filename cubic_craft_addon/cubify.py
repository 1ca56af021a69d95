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
from . import mesh_bridge
from .kernel_cache import use_extension_folder
from .object_frame import stretch_and_orientation
from .requirements import check_requirements
from .settings import Settings

PIN_THRESHOLD = 0.5
"""least weight in a pin group that pins a vertex"""


@dataclass(frozen=True)
class Prepared:
    """What is done once per mesh and pins."""

    name: str
    setup: solver.Setup
    stretch: np.ndarray
    orientation: np.ndarray
    original: np.ndarray
    """(n,3) float32 original positions, object space"""
    map_weights: np.ndarray | float
    """(n,) factors of the cubeness, or 1"""
    seconds: float

    @property
    def vertices(self):
        """Number of vertices."""
        return len(self.original)

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


def prepare(obj: bpy.types.Object, settings: Settings) -> Prepared:
    """Read and check the object, and factorise.

    Raises
    ------
    CubicCraftError
        The object or a setting cannot be used; the message names the object and the cure.
    """
    begin = time.perf_counter()
    stretch, orientation = stretch_and_orientation(obj, settings)
    original, rest = rest_shape(obj, stretch)
    pinned = np.zeros(len(original), dtype=bool)
    for group in settings.pin_groups:
        pinned |= mesh_bridge.group_weights(obj, group) >= PIN_THRESHOLD
    map_weights = 1.0
    if settings.map_group:
        map_weights = mesh_bridge.group_weights(obj, settings.map_group)
        if settings.map_invert:
            map_weights = 1.0 - map_weights
    try:
        setup = solver.Setup(rest, np.flatnonzero(pinned))
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{obj.name}": {error}') from error
    return Prepared(
        obj.name,
        setup,
        stretch,
        orientation,
        original,
        map_weights,
        time.perf_counter() - begin,
    )


def rest_shape(obj: bpy.types.Object, stretch):
    """Read the original positions (n,3) float32 and build the RestMesh of the stretched shape.

    Raises
    ------
    CubicCraftError
        The object cannot be used; the message names it and the cure.
    """
    check_requirements()
    mesh_bridge.check_editable(obj)
    mesh = mesh_bridge.mesh_of(obj)
    original = mesh_bridge.original_positions(mesh)
    triangles = mesh_bridge.triangles(mesh, original)
    try:
        return original, solver.rest_mesh(original.astype(np.float64) @ stretch.T, triangles)
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{obj.name}": {error}') from error


def solve(
    prepared: Prepared,
    settings: Settings,
    on_iteration: Callable[[solver.Stylization], bool] | None = None,
) -> Solution:
    """Solve; `on_iteration` is called after each iteration, a true value cancels the run.

    Raises
    ------
    CubicCraftError
        A setting cannot be used, or the device is not there.
    """
    use_extension_folder()
    try:
        stylization = solver.Stylization(
            prepared.setup,
            settings.cubeness * prepared.map_weights,
            prepared.orientation,
            device=settings.device.lower(),
        )
        result = solver.run(
            stylization,
            settings.max_iterations,
            settings.tolerance,
            _keeps_rotation(prepared, settings),
            on_iteration,
        )
    except solver.CubicCraftError as error:
        raise solver.CubicCraftError(f'"{prepared.name}": {error}') from error
    unstretch = np.linalg.inv(prepared.stretch)
    positions = (result.positions @ unstretch.T).astype(np.float32)
    # What the solver holds must not move by a rounding of the stretch.
    is_still = (result.positions == prepared.setup.rest.input_positions).all(axis=1)
    positions[is_still] = prepared.original[is_still]
    rotations = _unstretched(result.rotations, prepared.stretch)
    return Solution(positions, rotations, result, prepared.seconds)


def write(obj: bpy.types.Object, solution: Solution, result: str) -> bpy.types.Object:
    """Write a Solution to the object's mesh, to a shape key of it, or to a new object.

    Parameters
    ----------
    result : {"MESH", "SHAPE_KEY", "NEW_OBJECT"}

    Returns
    -------
    bpy.types.Object
        The object that now has the cubic shape.
    """
    if result == "SHAPE_KEY":
        mesh_bridge.write_shape_key(obj, solution.positions)
        return obj
    if result == "NEW_OBJECT":
        return mesh_bridge.write_new_object(obj, solution.positions, solution.rotations)
    mesh_bridge.write_mesh(mesh_bridge.mesh_of(obj), solution.positions, solution.rotations)
    return obj


def _keeps_rotation(prepared, settings):
    """Tell whether each free part is turned back as a whole at the end.

    A part may turn by some degrees to fit the cube. Several parts would each turn their own way and
    come apart, such as eyes from their sockets; a single one shows the sides of the cube as they
    are asked for.
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
