# SPDX-License-Identifier: GPL-3.0-or-later
"""The vertices of a handle of an object, and a new handle."""

from typing import Any

import bpy
import numpy as np

from ...solver.errors import CubicCraftError
from .. import mesh_bridge
from ..object_properties import object_properties
from .own_pose import identify

_MARGIN = 1.1  # size of the empty relative to the vertices it moves
_SMALLEST = 0.03  # radius of the empty, as part of the extent of the mesh


def add_handle(obj, group):
    """Add a pinned handle to the end of the object's list, make it active, and return it."""
    properties = object_properties(obj)
    handle = properties.handles.add()
    handle.group = group
    identify(handle)  # now, so that all undo steps made while Live runs include it
    properties.active_handle = len(properties.handles) - 1
    return handle


def members(obj, handle):
    """Return which vertices (n,) bool of the object are in the handle.

    Raises CubicCraftError: there is no such vertex group, or no vertex has enough weight.
    """
    found = mesh_bridge.group_weights(obj, handle.group) >= handle.threshold
    if not found.any():
        raise CubicCraftError(
            f'no vertex of "{obj.name}" has a weight of {handle.threshold:g} or more in the vertex'
            f' group "{handle.group}"; paint it or lower the threshold'
        )
    return found


def add_empty(context: bpy.types.Context, obj: Any, handle: Any) -> bpy.types.Object:
    """Return a new empty around the vertices of a handle, as they are seen.

    Raises CubicCraftError: the handle has no vertices.
    """
    is_member = members(obj, handle)
    shown = _shown_positions(context, obj)
    held = shown[is_member]
    empty = bpy.data.objects.new(f"{obj.name} {handle.group}", None)
    object_properties(empty).is_made_target = True
    low, high = held.min(axis=0), held.max(axis=0)
    radius = max(
        float((high - low).max()) / 2 * _MARGIN, float(np.ptp(shown, axis=0).max()) * _SMALLEST
    )
    empty.empty_display_type = "SPHERE"
    empty.empty_display_size = radius
    empty.show_in_front = True  # otherwise the mesh would hide it
    empty.parent = obj  # without an inverse: its own location is in the object's coordinates
    empty.location = (low + high) / 2
    mesh_bridge.link_beside(obj, empty)
    return empty


def is_ours_alone(target: bpy.types.Object):
    """Return whether we made the object and only collections and scenes still use it."""
    if not object_properties(target).is_made_target or target.library is not None:
        return False
    users = bpy.data.user_map(subset=[target])[target]
    return all(isinstance(user, (bpy.types.Collection, bpy.types.Scene)) for user in users)


def _shown_positions(context, obj):
    """Return the visible positions (n,3), if the modifiers keep the vertices."""
    seen = obj.evaluated_get(context.evaluated_depsgraph_get()).data
    if len(seen.vertices) != len(obj.data.vertices):
        return mesh_bridge.read_positions(obj.data).astype(np.float64)
    return mesh_bridge.read_values(seen.vertices, "co", width=3).astype(np.float64)
