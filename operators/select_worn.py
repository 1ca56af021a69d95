# SPDX-License-Identifier: GPL-3.0-or-later
"""Select Too: what lies on the active mesh becomes cubic with it."""

import bpy

from ..cubic_craft_addon.live import panel_mesh
from ..cubic_craft_addon.worn.found import worn_by
from ._shared.selection import poll_object_mode, poll_panel_mesh, poll_work
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_select_worn(bpy.types.Operator):
    """Add what lies on the mesh to the selection."""

    bl_idname = "cubic_craft.select_worn"
    bl_label = "Select Too"
    bl_description = (
        "Also select what lies on this mesh, such as its clothes and eyes. What is selected"
        " together becomes cubic together, so that nothing is left behind"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return (
            poll_work(cls, context)
            and poll_object_mode(cls, context)
            and poll_panel_mesh(cls, context)
        )

    @reporting
    def execute(self, context):
        obj = panel_mesh(context)
        worn = worn_by(obj)
        if not worn:
            self.report({"WARNING"}, f'Nothing lies on "{obj.name}"')
            return {"CANCELLED"}
        for each in (obj, *worn):
            each.select_set(True)
        context.view_layer.objects.active = obj
        return {"FINISHED"}
