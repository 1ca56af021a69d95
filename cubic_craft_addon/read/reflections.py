# SPDX-License-Identifier: GPL-3.0-or-later
"""The reflections of a half-modeled mesh: what its Mirror modifier adds is solved with it."""

from typing import Any

import bpy
import numpy as np

from ...solver.pieces.reflection import Reflection, flip


def modifier_reflections(obj: bpy.types.Object) -> tuple[Reflection, ...]:
    """Return the reflections of the first Mirror modifier of an object, in the viewport.

    Not one that cuts the mesh first (Bisect), whose vertices lie on both sides.
    """
    for modifier in obj.modifiers:
        if not isinstance(modifier, bpy.types.MirrorModifier) or not modifier.show_viewport:
            continue
        tolerance = modifier.merge_threshold if modifier.use_mirror_merge else 0.0
        flags: Any = modifier  # its vectors of flags can be indexed, which bpy's stubs cannot say
        numbers = [a for a in range(3) if flags.use_axis[a] and not flags.use_bisect_axis[a]]
        other = modifier.mirror_object
        place = np.eye(4) if other is None else matrix_between(other, obj)
        if place is None:
            return ()
        return tuple(flip(axis).placed(place, tolerance) for axis in numbers)
    return ()


def matrix_between(start: bpy.types.Object, end: bpy.types.Object) -> np.ndarray | None:
    """Return the matrix (4,4) from the coordinates of an object to another's, None for none."""
    own = np.array(end.matrix_world, dtype=np.float64)
    other = np.array(start.matrix_world, dtype=np.float64)
    if not (np.isfinite(own).all() and np.isfinite(other).all()):
        return None
    if min(abs(np.linalg.det(own)), abs(np.linalg.det(other))) < 1e-30:
        return None
    return np.linalg.inv(own) @ other
