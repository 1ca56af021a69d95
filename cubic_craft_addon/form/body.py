# SPDX-License-Identifier: GPL-3.0-or-later
"""The form of the settings, as a body for the solver."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from functools import lru_cache, partial

import bpy
import numpy as np

from ... import solver
from ...solver import CubicCraftError
from ...solver.styles import forms
from ...solver.styles.clusters import directions_of, enclosing
from ...solver.styles.form_names import OF_OBJECT
from ...solver.styles.hulls import simple_hull
from ...solver.styles.polytope import Polytope, from_directions
from .. import mesh_bridge
from ..environment.kept import KeptFrom, once
from ..environment.requirements import check_requirements
from .direction_text import read_directions
from .settings import FormSettings, check_directions, check_form_object

MOST_DIRECTIONS = 64
"""of a form from another object, or from selected faces"""
_made: dict[str, KeptFrom[Polytope]] = {kind: KeptFrom() for kind in OF_OBJECT}


def form_of(settings: FormSettings) -> Polytope | None:
    """Return the form, None for the cube.

    The same settings give the same object, so that forms can be compared by identity.

    Raises CubicCraftError: the form is that of another object which is not set or cannot be used,
    or that of faces of which none were picked.
    """
    if settings.form != "CUBE":
        check_requirements()
    if settings.form in OF_OBJECT:
        return _of_object(settings)
    if settings.form == "FACES":
        check_directions(settings.form, settings.form_directions)
        return _picked(settings.form_directions)
    return _named(settings.form, settings.form_sides, settings.form_weights)


@lru_cache(maxsize=64)
def _named(name, sides, weights):
    return forms.named(name.lower(), sides, weights)


@lru_cache(maxsize=64)
def _picked(text):
    directions = enclosing(read_directions(text))
    if len(directions) > MOST_DIRECTIONS:
        raise CubicCraftError(
            f"the form has {len(directions)} directions; give at most {MOST_DIRECTIONS}"
        )
    return from_directions(directions)


def _of_object(settings):
    obj = settings.form_object
    check_form_object(settings.form, obj)
    bpy.context.evaluated_depsgraph_get()  # or the matrix would be that before a change
    linear = np.array(obj.matrix_world.to_3x3(), dtype=np.float64)
    make = partial(_made_of, obj, settings.form, linear)
    return _made[settings.form].of(obj, make, linear.tobytes())


def _made_of(obj, form, linear):
    points, triangles = mesh_bridge.read_evaluated(obj)
    points = points @ linear.T  # in the axes of the world, about the object's origin
    try:
        if form == "OBJECT":
            return once(_hull, points)
        areas, normals = solver.triangle_areas_and_normals(points, triangles)
        normals *= np.sign(np.linalg.det(linear))
        return once(_facing, normals, areas)
    except CubicCraftError as error:
        raise CubicCraftError(f'"{obj.name}" gives no form: {error}') from error


def _hull(points):
    return simple_hull(points, MOST_DIRECTIONS)


def _facing(normals, areas):
    return from_directions(directions_of(normals, areas, MOST_DIRECTIONS))


def picked_directions(
    obj: bpy.types.Object, stretch: np.ndarray, orientation: np.ndarray
) -> tuple[np.ndarray, int]:
    """Return directions that make the selected faces sides of the form as it is turned now.

    `stretch`, `orientation`: (3,3), of `stretch_and_orientation`. Returns `directions`: (k,3), unit
    vectors in the frame of the form; they point to all sides; `count`: int, number of selected
    faces. Raises CubicCraftError: no face is selected, or none has an area.
    """
    check_requirements()
    vectors = mesh_bridge.read_selected_faces(mesh_bridge.mesh_of(obj))
    if not len(vectors):
        raise CubicCraftError("No face is selected; select some in Edit Mode first")
    # Areas as vectors are mapped by the cofactors.
    seen = vectors @ (np.linalg.det(stretch) * np.linalg.inv(stretch)).T @ orientation.T
    areas = np.linalg.norm(seen, axis=1)
    has_area = np.isfinite(areas) & (areas > 0.0)
    if not has_area.any():
        raise CubicCraftError(f'the selected faces of "{obj.name}" have no area; select others')
    seen, areas = seen[has_area], areas[has_area]
    return directions_of(seen / areas[:, None], areas, MOST_DIRECTIONS), len(vectors)
