# SPDX-License-Identifier: GPL-3.0-or-later
"""From the options of the command to the arguments of the solver."""

from argparse import Namespace

import numpy as np
from scipy.spatial.transform import Rotation

from solver import CubicCraftError, Result, stylize
from solver.aliases import Faces
from solver.console.method_options import settings_from
from solver.method import IN_LIBRARY, Method
from solver.proxy.options import proxy_of
from solver.styles import forms


def stylized(points: np.ndarray, faces: Faces, options: Namespace) -> Result:
    """Return the result for a surface of points (n,3) and faces, of any numbers of corners.

    Raises CubicCraftError: the solver refuses the mesh or an option.
    """
    turn = Rotation.from_euler("xyz", options.orientation, degrees=True)  # as Blender's XYZ angles
    method = Method(**settings_from(vars(options), *IN_LIBRARY))
    try:
        return stylize(
            points,
            faces,
            method.cubeness,
            max_iterations=method.max_iterations,
            tolerance=method.tolerance,
            proxy=proxy_of(method),
            orientation=turn.as_matrix().T if any(options.orientation) else None,
            crispness=method.crispness,
            detail_strength=method.detail_strength,
            form=forms.named(options.form, method.form_sides, method.form_weights),
            device=options.device,
            keep_rotation=method.rotation == "KEEP",
        )
    except MemoryError:
        raise CubicCraftError("there is not enough memory for it") from None
