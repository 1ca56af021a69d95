# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of an object in another shape, without shape keys and without data of ours."""

import bpy
import numpy as np

from ..access.arrays import mark_moved, write_position
from ..access.checks import mesh_of
from ..access.copies import remove_copy
from .restore import discard_original


def plain_copy(obj: bpy.types.Object, positions: np.ndarray) -> bpy.types.Object:
    """Copy an object and its mesh, and give the copy other positions.

    It keeps UVs, materials, vertex groups and modifiers, and is in no scene yet.

    `obj`: an object with a mesh, not in Edit Mode. `positions`: (n,3) float32, object space. Raises
    CubicCraftError: a mesh that cannot be written; no copy is left then.
    """
    new_mesh, new = mesh_of(obj).copy(), obj.copy()
    assert new_mesh is not None and new is not None
    new.data = new_mesh  # first, so that shape keys are removed from the copy alone
    try:
        _strip(new, new_mesh)
        write_position(new_mesh, positions)
        mark_moved(new_mesh)
    except BaseException:
        remove_copy(new)
        raise
    return new


def _strip(new: bpy.types.Object, mesh: bpy.types.Mesh) -> None:
    """Remove the shape keys and all data of ours, which do not fit fewer vertices."""
    if mesh.shape_keys is not None:
        name = mesh.shape_keys.name
        new.shape_key_clear()
        left = bpy.data.shape_keys.get((name, None))
        if left is not None:  # Blender counts a user too many for copied shape keys
            bpy.data.batch_remove((left,))
    new.active_shape_key_index = 0
    new.show_only_shape_key = False
    discard_original(mesh)
