# SPDX-License-Identifier: GPL-3.0-or-later
"""Follow an Empty: create the object that a handle follows."""

import bpy
import numpy as np

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.handles.pose import live_target
from ..cubic_craft_addon.object_properties import object_properties
from ..solver import CubicCraftError
from ._shared.active_handle import active_handle, members, poll_handle
from ._shared.selection import report_all

_MARGIN = 1.1  # size of the empty relative to the vertices it moves
_SMALLEST = 0.03  # radius of the empty, as part of the extent of the mesh


class CUBIC_CRAFT_OT_handle_follow(bpy.types.Operator):
    """Make an empty that the active handle follows."""

    bl_idname = "cubic_craft.handle_follow"
    bl_label = "Follow an Empty"
    bl_description = (
        "Add an empty at the center of the handle's vertices and select it. When you move, rotate"
        " or scale it, the next Cubify moves the vertices along and bends the rest"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is an active handle that follows nothing yet."""
        if not poll_handle(cls, context):
            return False
        target = live_target(active_handle(panel_object(context)))
        if target is not None:
            cls.poll_message_set(f'The handle already follows "{target.name}"')
            return False
        return True

    def execute(self, context):
        """Make the empty, bind the handle to it, and select it."""
        obj = panel_object(context)
        handle = active_handle(obj)
        try:
            is_member = members(obj, handle)
        except CubicCraftError as error:
            return report_all(self, "", [str(error)])
        shown = _shown_positions(context, obj)
        empty = _add_empty(context, obj, handle.group, shown, shown[is_member])
        handle.target = empty  # binds it
        if context.view_layer.objects.get(empty.name) == empty:
            bpy.ops.object.select_all(action="DESELECT")
            empty.select_set(True)
            context.view_layer.objects.active = empty
        return report_all(self, f'"{handle.group}" follows "{empty.name}"', [])


def _shown_positions(context, obj):
    """Return the visible positions (n,3), if the modifiers keep the vertices."""
    count = len(obj.data.vertices)
    seen = obj.evaluated_get(context.evaluated_depsgraph_get()).data
    if len(seen.vertices) != count:
        return mesh_bridge.read_positions(obj.data).astype(np.float64)
    positions = np.empty(3 * count, dtype=np.float32)
    seen.vertices.foreach_get("co", positions)
    return positions.reshape(-1, 3).astype(np.float64)


def _add_empty(context, obj, group, shown, held):
    empty = bpy.data.objects.new(f"{obj.name} {group}", None)
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
    collections = [c for c in obj.users_collection if c.is_editable]
    for collection in collections or [context.scene.collection]:
        collection.objects.link(empty)
    return empty
