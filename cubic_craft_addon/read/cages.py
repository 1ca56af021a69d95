# SPDX-License-Identifier: GPL-3.0-or-later
"""Cages, of which a Subdivision Surface modifier shows the smooth surface."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from typing import Any

import bpy
import numpy as np

from ...solver.mesh.catmull_clark import FULL, Cage
from ...solver.pieces.subdivided import MOST
from .. import mesh_bridge
from .reflections import modifier_reflections

_MOVING = {"ARMATURE", "HOOK", "LATTICE", "MESH_DEFORM"}
"""modifiers before it that leave the faces as they are"""


def subdivision_of(obj: bpy.types.Object) -> tuple[str, bool] | None:
    """Return how an object is smoothed, as the options of its modifier; None if it is no cage.

    Only its mirror images may be added before. If another modifier changes the faces first, what
    the smooth surface depends on is not what becomes cubic.
    """
    for modifier in obj.modifiers:
        if not modifier.show_viewport:
            continue
        if isinstance(modifier, bpy.types.SubsurfModifier):
            is_smooth = modifier.subdivision_type == "CATMULL_CLARK" and modifier.levels > 0
            return (modifier.boundary_smooth, modifier.use_creases) if is_smooth else None
        if modifier.type not in _MOVING and not _is_understood(obj, modifier):
            return None
    return None


def _is_understood(obj, modifier):
    """Return whether a modifier is the mirror of `modifier_reflections`, and merges the halves."""
    if not isinstance(modifier, bpy.types.MirrorModifier) or not modifier.use_mirror_merge:
        return False
    flags: Any = modifier  # as in `reflections.py`
    axes = [axis for axis in range(3) if flags.use_axis[axis]]
    mirrors = [each for each in obj.modifiers if each.type == "MIRROR" and each.show_viewport]
    return len(mirrors) == 1 and len(axes) == len(modifier_reflections(obj))


def read_cage(obj: bpy.types.Object) -> Cage | None:
    """Read the faces of a cage with its creases; None if it is none, or fine enough by itself."""
    options, mesh = subdivision_of(obj), mesh_bridge.mesh_of(obj)
    if options is None or not mesh.polygons:
        return None
    boundary, has_creases = options
    sizes = mesh_bridge.read_values(mesh.polygons, "loop_total", np.int32)
    count = len(mesh.vertices)
    corners = mesh_bridge.corner_vertices(mesh).astype(np.int64)
    edges, stiffness = np.empty((0, 2), np.int64), np.zeros(count)
    sharpness = np.empty(0)
    if has_creases:
        sharpness = _creases(mesh, "crease_edge", len(mesh.edges))
        stiffness = _creases(mesh, "crease_vert", count)
        edges = mesh_bridge.read_values(mesh.edges, "vertices", np.int32, 2)
        edges = edges[sharpness > 0.0].astype(np.int64)
        sharpness = sharpness[sharpness > 0.0]
    keeps_corners = boundary == "PRESERVE_CORNERS"
    cage = Cage(sizes.astype(np.int64), corners, edges, sharpness, stiffness, keeps_corners)
    is_coarse = cage.count(1) << len(modifier_reflections(obj)) <= MOST
    return cage if is_coarse and sizes.min() > 2 else None


def _creases(mesh, name, count):
    """Return for how many levels creases stay sharp: ten times the square of what Blender shows."""
    values, attribute = np.zeros(count, np.float32), mesh.attributes.get(name)
    if isinstance(attribute, bpy.types.FloatAttribute) and len(attribute.data) == count:
        values = mesh_bridge.read_values(attribute.data, "value")
    return FULL * values.astype(np.float64) ** 2
