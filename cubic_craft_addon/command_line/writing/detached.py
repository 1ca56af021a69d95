# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies that carry a result, independent of everything else in the file."""

import bpy
import numpy as np

from ...mesh_bridge import plain_copy


def detached_copy(
    obj: bpy.types.Object, positions: np.ndarray, keep_modifiers: bool
) -> bpy.types.Object:
    """Copy an object and its mesh, place it where the object is, and give it other positions.

    The copy has no parent, animation, constraints or shape keys, and it is in no collection yet.

    `positions`: (n,3) float32, object space. `keep_modifiers`: keep those that need no other
    object; without them the mesh is what is exported.
    """
    place = obj.matrix_world.copy()
    copy = plain_copy(obj, positions)
    copy.animation_data_clear()
    copy.constraints.clear()
    copy.parent = None
    copy.matrix_world = place
    copy.hide_render = False
    for modifier in list(copy.modifiers):
        if not keep_modifiers or _needs_object(modifier):
            copy.modifiers.remove(modifier)
    return copy


def _needs_object(modifier: bpy.types.Modifier) -> bool:
    """Return whether a modifier refers to another object, whose place the copy does not share."""
    return any(
        prop.type == "POINTER" and isinstance(getattr(modifier, prop.identifier), bpy.types.Object)
        for prop in modifier.bl_rna.properties
    )
