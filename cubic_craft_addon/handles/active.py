# SPDX-License-Identifier: GPL-3.0-or-later
"""The handle that is active in the list of an object, its vertices, and a new one."""

from typing import Any

from ...solver.errors import CubicCraftError
from .. import mesh_bridge
from ..object_properties import object_properties
from .own_pose import identify


def active_handle(obj) -> Any:
    """Return the handle of the object that is active in its list, or None."""
    properties = object_properties(obj)
    number = properties.active_handle
    return properties.handles[number] if number < len(properties.handles) else None


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
