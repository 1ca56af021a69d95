# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a region: a vertex group of the mesh with a form of its own."""

import bpy
from bpy.props import StringProperty

from ..cubic_craft_addon import live
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.object_properties import object_properties
from ..cubic_craft_addon.regions.active import add_region
from ..solver.errors import CubicCraftError
from ._shared.group_to_add import group_to_add, poll_groups
from ._shared.selection import report_all


class CUBIC_CRAFT_OT_region_add(bpy.types.Operator):
    """Give a vertex group a form of its own."""

    bl_idname = "cubic_craft.region_add"
    bl_label = "Add Region"
    bl_description = (
        "Give the active vertex group, or the first one that is not a region yet, a form, an"
        " orientation and a cubeness of its own. They begin as those of the object"
    )
    bl_options = {"REGISTER", "UNDO"}

    group: StringProperty(
        name="Vertex Group",
        description="Vertex group that the region covers; empty for the active one",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        """There is a mesh with a vertex group."""
        return poll_groups(cls, context, "Region from Selection")

    def execute(self, context):
        """Add the region with the settings of the object."""
        obj = panel_object(context)
        taken = {region.group for region in object_properties(obj).regions}
        try:
            self.group = group_to_add(obj, self.group, taken, "is a region")
            add_region(obj, self.group, live.settings_now(obj))
        except CubicCraftError as error:
            return report_all(self, "", [str(error)])
        return report_all(self, f'Added the region "{self.group}"', [])
