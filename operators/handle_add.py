# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a handle that holds a vertex group of the mesh, or the selected vertices."""

import bpy

from ..cubic_craft_addon.handles.active import add_handle
from ..cubic_craft_addon.object_properties import object_properties
from ._shared.groups import AddsGroup, AddsSelection


class CUBIC_CRAFT_OT_handle_add(AddsGroup, bpy.types.Operator):
    bl_idname = "cubic_craft.handle_add"
    bl_label = "Add Handle"
    bl_description = (
        "Hold the vertices of the active vertex group, or of the first group that is not held yet,"
        " but not a map. Where handles overlap, the first takes precedence"
    )
    other, already = "Pin Selection", "has a handle"

    def taken(self, obj):
        """Return the groups that are held."""
        return {handle.group for handle in object_properties(obj).handles}

    def add(self, obj):
        """Add the handle, pinned."""
        add_handle(obj, self.group)
        return f'Added a handle for "{self.group}"'


class CUBIC_CRAFT_OT_handle_pin_selection(AddsSelection, bpy.types.Operator):
    bl_idname = "cubic_craft.handle_pin_selection"
    bl_label = "Pin Selection"
    bl_description = (
        "Hold the vertices that are selected in Edit Mode by making them a vertex group with a"
        " handle"
    )
    new = "Handle"

    def add(self, obj, group, count, values):
        """Add the handle, pinned."""
        add_handle(obj, group)
        return f'Pinned {count} vertices as "{group}"'
