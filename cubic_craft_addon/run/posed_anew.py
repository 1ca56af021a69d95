# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a result was posed anew since its run, as by *Apply Pose as Rest Pose*.

Its original is still in the former pose. What was moved since then would be put back onto the next
result as strokes of the artist, which tears it where the pose differs.
"""

from typing import Any

import bpy
import numpy as np

from ...solver.errors import CubicCraftError
from .. import mesh_bridge

_SAME = 1e-3  # of the size
_NEARLY_ALL = 0.9  # of the vertices
REST = "rest"
"""what a note calls the ends of the bones, with the settings of a run"""


def is_posed_anew(obj: bpy.types.Object) -> bool:
    """Return whether nearly all vertices were moved by hand, or some and the rest pose was, too.

    Not where the mesh has moved as a whole. As expensive as `mesh_bridge.is_edited`.
    """
    mesh = mesh_bridge.mesh_of(obj)
    try:
        offsets = mesh_bridge.offsets_by_hand(mesh)
        if offsets is None:
            return False
        size = float(np.ptp(mesh_bridge.read_positions(mesh), axis=0).max())
    except CubicCraftError:
        return False
    is_moved = np.linalg.norm(offsets, axis=1) > _SAME * size
    return bool(is_moved.mean() > _NEARLY_ALL) or (is_moved.any() and _has_other_rest(obj, size))


def _has_other_rest(obj: bpy.types.Object, size: float) -> bool:
    """Return whether bones have other ends than in the run, but for where the mesh was moved."""
    from ..read.bones import bone_places  # takes part of the solver along

    run = mesh_bridge.last_run(obj)
    then: Any = run and run.settings.get(REST)
    places = bone_places(obj)
    if places is None or not isinstance(then, list) or len(then) != len(places.ends):
        return False
    before = mesh_bridge.moved_as_a_whole(mesh_bridge.mesh_of(obj), np.reshape(then, (-1, 3)))
    if before is None:
        return False
    away = np.linalg.norm(_apart(before, np.reshape(places.ends, (-1, 3))), axis=1)
    return bool(away.max() > _SAME * size)


def _apart(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Return offsets (k,3) of points, but for a rotation and a shift: a rig may be moved."""
    one, other = before - before.mean(axis=0), after - after.mean(axis=0)
    U, _, Vt = np.linalg.svd(one.T @ other)
    U[:, -1] *= np.sign(np.linalg.det(U @ Vt))
    return one @ U @ Vt - other
