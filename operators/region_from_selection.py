# SPDX-License-Identifier: GPL-3.0-or-later
"""Region from Selection: the selected vertices become a vertex group and a region."""

import bpy

from ..cubic_craft_addon import live
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.regions.active import add_region
from ..solver import CubicCraftError
from ._shared.group_of_selection import group_of_selection
from ._shared.selection import poll_mesh, report_all

_GROUP = "Region"


class CUBIC_CRAFT_OT_region_from_selection(bpy.types.Operator):
    """Give the selected vertices a form of their own."""

    bl_idname = "cubic_craft.region_from_selection"
    bl_label = "Region from Selection"
    bl_description = (
        "Give the vertices that are selected in Edit Mode a form of their own by making them a"
        " vertex group and a region"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is a mesh in Edit Mode, where the selection is seen."""
        return poll_mesh(cls, context, ("EDIT_MESH",))

    def execute(self, context):
        """Make the vertex group and the region."""
        obj = panel_object(context)
        try:
            settings = live.settings_now(obj)
            group, count = group_of_selection(obj, _GROUP)
        except CubicCraftError as error:
            return report_all(self, "", [str(error)])
        add_region(obj, group.name, settings)
        return report_all(self, f'Made {count} vertices the region "{group.name}"', [])
