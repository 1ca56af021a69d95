# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove a region from the list; its vertex group stays."""

import bpy

from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.object_properties import object_properties
from ..cubic_craft_addon.regions.region import active_region
from ._shared.selection import poll_mesh, refuse


class CUBIC_CRAFT_OT_region_remove(bpy.types.Operator):
    """Remove the active region."""

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
        if active_region(panel_object(context)) is None:
            return refuse(cls, "Add a region first")
        return True

    def execute(self, context):
        properties = object_properties(panel_object(context))
        properties.regions.remove(properties.active_region)
        last = len(properties.regions) - 1
        properties.active_region = max(min(properties.active_region, last), 0)
        return {"FINISHED"}
