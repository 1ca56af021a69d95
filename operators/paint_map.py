# SPDX-License-Identifier: GPL-3.0-or-later
"""Paint Map: the vertex group of the cubeness map, ready to be painted."""

import bpy

from ..cubic_craft_addon import live
from ..cubic_craft_addon.handles.owner import panel_object
from ._shared.selection import poll_mesh
from ._shared.unexpected_errors import reporting

_GROUP = "Cubeness"


class CUBIC_CRAFT_OT_paint_map(bpy.types.Operator):
    bl_idname = "cubic_craft.paint_map"
    bl_label = "Paint Map"
    bl_description = (
        "Paint how cubic the mesh becomes: red is as cubic as Cubeness says, blue stays as it is."
        " Makes the vertex group, red everywhere, if there is none yet"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return poll_mesh(cls, context, ("OBJECT", "PAINT_WEIGHT"))

    @reporting
    def execute(self, context):
        if context.mode == "PAINT_WEIGHT":
            bpy.ops.object.mode_set(mode="OBJECT")
            return {"FINISHED"}
        obj = panel_object(context)
        context.view_layer.objects.active = obj
        properties = live.own_properties(obj)
        group = obj.vertex_groups.get(properties.map_group)
        if group is None:
            group = obj.vertex_groups.new(name=_GROUP)
            group.add(range(len(obj.data.vertices)), 1.0, "REPLACE")
            properties.map_group = group.name
        obj.vertex_groups.active = group
        bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
        self.report({"INFO"}, "Paint blue where the mesh is to stay as it is")
        return {"FINISHED"}
