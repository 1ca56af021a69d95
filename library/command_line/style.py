# SPDX-License-Identifier: GPL-3.0-or-later
"""From the options of the command to the arguments of the solver."""

from argparse import Namespace

import numpy as np
from scipy.spatial.transform import Rotation

from solver import CubicCraftError, ProxyOptions, Result, stylize
from solver.console.errors import InputError
from solver.styles import forms
from solver.styles.polytope import Polytope

from .surface import Surface

__all__ = ("form_of", "orientation_of", "stylized")

_NAMED = {
    "rounded": forms.rounded_cube,
    "octahedron": forms.octahedron,
    "tetrahedron": forms.tetrahedron,
    "dodecahedron": forms.dodecahedron,
    "icosahedron": forms.icosahedron,
    "rhombic": forms.rhombic_dodecahedron,
    "cylinder": forms.cylinder,
    "cone": forms.cone,
}


def stylized(surface: Surface, options: Namespace) -> Result:
    """Return the result for a surface.

    Raises
    ------
    InputError
        The solver refuses the mesh or an option; the message lacks the path.
    """
    try:
        return stylize(
            surface.points,
            surface.triangles,
            options.cubeness,
            max_iterations=options.max_iterations,
            tolerance=options.tolerance,
            proxy=ProxyOptions(
                solidity=options.solidity,
                together=options.together != "off",
                refine=options.refine != "off",
                keep_pose=options.keep_pose == "on",
                detail=options.detail,
                keep_apart=options.keep_apart == "on",
            ),
            orientation=orientation_of(options.orientation),
            form=form_of(options),
            device=options.device,
            keep_rotation=options.rotation == "keep",
        )
    except CubicCraftError as error:
        raise InputError(str(error)) from error
    except MemoryError:
        raise InputError("there is not enough memory for it") from None


def form_of(options: Namespace) -> Polytope | None:
    """Return the form of the options, None for the cube."""
    if options.form == "box":
        is_cube = options.form_weights == [1.0, 1.0, 1.0]
        return None if is_cube else forms.box(options.form_weights)
    if options.form == "prism":
        return forms.prism(options.form_sides)
    if options.form == "pyramid":
        return forms.pyramid(options.form_sides)
    return _NAMED[options.form]() if options.form in _NAMED else None


def orientation_of(degrees: list[float]) -> np.ndarray | None:
    """Return the rotation (3,3) that maps the axes of the file to those of the form, if it turns.

    The angles are Blender's XYZ Euler angles.
    """
    if not any(degrees):
        return None
    return Rotation.from_euler("xyz", degrees, degrees=True).as_matrix().T
