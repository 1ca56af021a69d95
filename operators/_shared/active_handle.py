# SPDX-License-Identifier: GPL-3.0-or-later
"""Shared by the operators on handles: the mesh and the active handle."""

from typing import Any

from ...cubic_craft_addon import mesh_bridge
from ...cubic_craft_addon.handles.own_pose import identify
from ...cubic_craft_addon.handles.owner import panel_object
from ...cubic_craft_addon.object_properties import object_properties
from ...solver import CubicCraftError
from .selection import poll_idle


def poll_mesh(operator_class, context, modes=("OBJECT",)):
    """Return whether there is a mesh whose handles can be changed, and set the message if not."""
    if not poll_idle(operator_class):
        return False
    if context.mode not in modes:
        is_edited = "OBJECT" not in modes
        operator_class.poll_message_set(
            "Select vertices in Edit Mode first" if is_edited else "Switch to Object Mode first"
        )
        return False
    obj = panel_object(context)
    if obj is None:
        operator_class.poll_message_set("Make a mesh object active first")
        return False
    if not obj.is_editable:
        operator_class.poll_message_set("The object is linked from another file; make it local")
        return False
    return True


def poll_handle(operator_class, context):
    """Return whether there is an active handle, and set the message if not."""
    if not poll_mesh(operator_class, context):
        return False
    if active_handle(panel_object(context)) is None:
        operator_class.poll_message_set("Add a handle first")
        return False
    return True


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

    Raises
    ------
    CubicCraftError
        There is no such vertex group, or no vertex has enough weight.
    """
    found = mesh_bridge.group_weights(obj, handle.group) >= handle.threshold
    if not found.any():
        raise CubicCraftError(
            f'no vertex of "{obj.name}" has a weight of {handle.threshold:g} or more in the vertex'
            f' group "{handle.group}"; paint it or lower the threshold'
        )
    return found
