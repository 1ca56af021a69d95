# SPDX-License-Identifier: GPL-3.0-or-later
"""Pin Selection: the selected vertices become a vertex group with a handle."""

import bpy

from ..cubic_craft_addon.handles.active import add_handle
from ..cubic_craft_addon.handles.owner import panel_object
from ..solver import CubicCraftError
from ._shared.group_of_selection import group_of_selection
from ._shared.selection import poll_mesh, report_all

_GROUP = "Handle"


class CUBIC_CRAFT_OT_handle_pin_selection(bpy.types.Operator):
    """Hold the selected vertices."""

    bl_idname = "cubic_craft.handle_pin_selection"
    bl_label = "Pin Selection"
    bl_description = (
        "Hold the vertices that are selected in Edit Mode by making them a vertex group with a"
        " handle"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is a mesh in Edit Mode, where the selection is seen."""
        return poll_mesh(cls, context, ("EDIT_MESH",))

    def execute(self, context):
        """Make the vertex group and the handle."""
        obj = panel_object(context)
        try:
            group, count = group_of_selection(obj, _GROUP)
        except CubicCraftError as error:
            return report_all(self, "", [str(error)])
        add_handle(obj, group.name)
        return report_all(self, f'Pinned {count} vertices as "{group.name}"', [])
