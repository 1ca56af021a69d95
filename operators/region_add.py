# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a region, of a vertex group or of the selected vertices, or remove it."""

import bpy

from ..cubic_craft_addon import live
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.object_properties import active_entry, object_properties, remove_active
from ..cubic_craft_addon.regions.region import add_region
from ._shared.groups import AddsGroup, AddsSelection
from ._shared.selection import poll_mesh, refuse


class CUBIC_CRAFT_OT_region_add(AddsGroup, bpy.types.Operator):
    bl_idname = "cubic_craft.region_add"
    bl_label = "Add Region"
    bl_description = (
        "Give the active vertex group, or the first one that is not a region yet, but not a map, a"
        " form, an orientation and a cubeness of its own. They begin as those of the object"
    )
    other, already = "Region from Selection", "is a region"

    def taken(self, obj):
        """Return the groups that are regions."""
        return {region.group for region in object_properties(obj).regions}

    def add(self, obj):
        """Add the region with the settings of the object."""
        add_region(obj, self.group, live.settings_now(obj))
        return f'Added the region "{self.group}"'


class CUBIC_CRAFT_OT_region_from_selection(AddsSelection, bpy.types.Operator):
    bl_idname = "cubic_craft.region_from_selection"
    bl_label = "Region from Selection"
    bl_description = (
        "Give the vertices that are selected in Edit Mode a form of their own by making them a"
        " vertex group and a region"
    )
    new = "Region"

    def values(self, obj):
        """Return the settings of the object, which may be invalid."""
        return live.settings_now(obj)

    def add(self, obj, group, count, values):
        """Add the region."""
        add_region(obj, group, values)
        return f'Made {count} vertices the region "{group}"'


class CUBIC_CRAFT_OT_region_remove(bpy.types.Operator):
    bl_idname = "cubic_craft.region_remove"
    bl_label = "Remove Region"
    bl_description = (
        "Remove the active region, so that its vertices have the settings of the object again. The"
        " vertex group is kept"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not poll_mesh(cls, context, ("OBJECT", "PAINT_WEIGHT")):
            return False
        if active_entry(panel_object(context), "region") is None:
            return refuse(cls, "Add a region first")
        return True

    def execute(self, context):
        remove_active(panel_object(context), "region")
        return {"FINISHED"}
