# SPDX-License-Identifier: GPL-3.0-or-later
"""From the options of the command to the arguments of the solver."""

from argparse import Namespace

import numpy as np
from scipy.spatial.transform import Rotation

from solver import CubicCraftError, ProxyOptions, Result, stylize
from solver.console.errors import InputError
from solver.styles import forms

from .surface import Surface

__all__ = ("orientation_of", "stylized")


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
            crispness=options.crispness,
            detail_strength=options.detail_strength,
            form=forms.named(options.form, options.form_sides, options.form_weights),
            device=options.device,
            keep_rotation=options.rotation == "keep",
        )
    except CubicCraftError as error:
        raise InputError(str(error)) from error
    except MemoryError:
        raise InputError("there is not enough memory for it") from None


def orientation_of(degrees: list[float]) -> np.ndarray | None:
    """Return the rotation (3,3) that maps the axes of the file to those of the form, if it turns.

    The angles are Blender's XYZ Euler angles.
    """
    if not any(degrees):
        return None
    return Rotation.from_euler("xyz", degrees, degrees=True).as_matrix().T
