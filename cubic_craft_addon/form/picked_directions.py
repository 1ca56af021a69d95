# SPDX-License-Identifier: GPL-3.0-or-later
"""The directions of a form from the faces that are selected in Edit Mode."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import bpy
import numpy as np

from ...solver import CubicCraftError
from ...solver.styles.clusters import directions_of
from .. import mesh_bridge
from ..environment.requirements import check_requirements
from .body import MOST_DIRECTIONS


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
