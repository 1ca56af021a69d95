# SPDX-License-Identifier: GPL-3.0-or-later
"""The normal capture of the settings, for the solver: which way surfaces should face."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import hashlib
from functools import partial
from typing import Any

import bpy
import numpy as np

from ... import solver
from ...solver import CubicCraftError
from ...solver.mesh.rest_measures import areas_and_normals
from .. import mesh_bridge
from ..environment.kept import KeptFrom, once
from ..environment.requirements import check_requirements
from .settings import FormSettings

STRENGTH = 4.0
"""of the solver, for a strength of 1: with a cube for a ball, the same strength and cubeness deform
a monkey equally much, by the first term of the energy"""

_captures: KeptFrom[solver.NormalCapture] = KeptFrom()
_digests: KeptFrom[str] = KeptFrom()


def has_capture(settings: FormSettings) -> bool:
    """Return whether the settings have a normal capture that is felt."""
    return settings.capture_object is not None and settings.capture_strength > 0.0


def capture_of(obj: bpy.types.Object, settings: FormSettings) -> solver.NormalCapture | None:
    """Return the normal capture for an object, None for none.

    The same settings give the same object, so that captures can be compared by identity.

    Raises CubicCraftError: the object that it is made from cannot be used.
    """
    ball = settings.capture_object
    if ball is None or not has_capture(settings):
        return None
    if ball == obj:
        raise CubicCraftError(f'"{obj.name}" cannot be its own normal capture; pick another ball')
    check_requirements()
    bpy.context.evaluated_depsgraph_get()  # or the matrix would be that before a change
    linear = np.array(ball.matrix_world.to_3x3(), dtype=np.float64)
    make = partial(_made_of, ball, linear)
    return _captures.of(ball, make, (_has_original(ball), linear.tobytes()))


def note_of(settings: FormSettings) -> Any:
    """Return what the normal capture is made from, as values for JSON; None for none."""
    ball = settings.capture_object
    if ball is None or not has_capture(settings):
        return None
    try:
        digest = _digests.of(ball, partial(_digest, ball), _has_original(ball))
    except CubicCraftError:
        return None
    turn = np.array(ball.matrix_world.to_3x3(), dtype=np.float64)
    return [digest, {"matrix": turn.ravel().tolist()}]


def strength_of(settings: FormSettings) -> float:
    """Return how strongly the normals are drawn, as the solver takes it."""
    return STRENGTH * settings.capture_strength if has_capture(settings) else 0.0


def _read(ball):
    """Return points (n,3) and triangles (m,3) as they are seen, and points before Cubify or None.

    The latter only where each vertex has one: with the same modifiers that add none.
    """
    points, triangles = mesh_bridge.read_evaluated(ball)
    if not len(triangles):
        raise CubicCraftError(f'"{ball.name}" has no surface; pick another object')
    if _has_original(ball):
        before = mesh_bridge.original_positions(ball.data, "ORIGINAL")
        if len(before) == len(points):
            return points, triangles, before.astype(np.float64)
    return points, triangles, None


def _has_original(ball):
    return isinstance(ball.data, bpy.types.Mesh) and mesh_bridge.has_original(ball.data)


def _made_of(ball, linear):
    points, triangles, before = _read(ball)
    side = np.sign(np.linalg.det(linear))
    points = points @ linear.T  # in the axes of the world, about the object's origin
    normals = side * areas_and_normals(points, triangles)[1]
    directions = points
    if before is not None:
        directions = side * areas_and_normals(before @ linear.T, triangles)[1]
    try:
        return once(solver.NormalCapture, directions, normals)
    except CubicCraftError as error:
        raise CubicCraftError(f'"{ball.name}" is not a normal capture: {error}') from error


def _digest(ball):
    found = hashlib.sha256()
    for values in _read(ball):
        found.update(b"" if values is None else values.tobytes())
    return found.hexdigest()
