# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh in the shape of a result becomes few planar polygons, if they are enough triangles.

Decimation counts the distance from the surface only, and cuts corners of sides, and eyes and noses,
to save it. Planar polygons have the sides of the result, with straight edges between them, and what
is decimated afterwards is the little that they are too many.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import bpy
import numpy as np

from ...solver.pieces.placement import Placement
from .. import mesh_bridge
from ..measure.facets import Surface, form_directions

_FIRST, _FINEST, _COARSEST = 0.01, 0.0025, 0.04
"""tolerances, of the largest extent"""
_MORE = 1.2
"""times: so many more triangles than asked for leave decimation a choice"""
_MOST = 3.0
"""times: more would leave the choice to decimation alone; so would a finest tolerance too large"""
_LEAST = 0.75
"""times: with fewer, decimation of the whole mesh is closer to it"""
_POWER = 1.5
"""of the number of triangles: how the tolerance falls with it, as measured"""


def few_polygons(mesh: bpy.types.Mesh, placement: Placement, triangles: int) -> None:
    """Put planar polygons in place of the faces of a mesh, if that helps.

    `mesh`: in the shape of a result, also with modifiers. `placement`: of its object. `triangles`:
    so many there should be, about.
    """
    if len(mesh.loops) - 2 * len(mesh.polygons) <= triangles:
        return
    directions = np.concatenate([form_directions(style) for style in placement.styles])
    surface = Surface(mesh, mesh_bridge.read_position(mesh), placement, directions)
    polygons = surface.polygons(_FIRST)
    count = _triangles(polygons)
    if not triangles <= count <= _MOST * triangles:
        tolerance = _FIRST * (count / (_MORE * triangles)) ** _POWER
        if tolerance < _FINEST / _MOST:
            return
        polygons = surface.polygons(float(np.clip(tolerance, _FINEST, _COARSEST)))
        count = _triangles(polygons)
    if count >= _LEAST * triangles:
        mesh_bridge.rebuild(mesh, polygons)


def _triangles(polygons: mesh_bridge.Polygons) -> int:
    return sum(len(loop) - 2 for loop in polygons.loops)
