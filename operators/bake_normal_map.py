# SPDX-License-Identifier: GPL-3.0-or-later
"""Bake Normal Map: a low-poly version of a cubic mesh, which shows the details of the cubic one."""

import bpy

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.screen.redraw import waiting
from ..cubic_craft_addon.send.normal_map import make_normal_map
from ..cubic_craft_addon.send.properties import MapOptions, NormalMapProperties, normal_map_settings
from ..solver import CubicCraftError
from ._shared.selection import poll_any_usable, poll_object_mode, poll_work, refuse, report_all
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_bake_normal_map(NormalMapProperties, bpy.types.Operator):
    bl_idname = "cubic_craft.bake_normal_map"
    bl_label = "Bake Normal Map"
    bl_description = (
        "Make a low-poly version of the active cubic mesh, and bake the details"
        " that it lacks to a normal map. The cubic mesh is hidden, not changed"
    )
    bl_options = {"UNDO"}  # no redo panel: each change would write another image

    @classmethod
    def poll(cls, context):
        if not (poll_work(cls, context) and poll_object_mode(cls, context)):
            return False
        obj = panel_object(context)
        if obj is None or mesh_bridge.last_run(obj) is None:
            return refuse(cls, "The mesh has no result to bake; cubify it first")
        return poll_any_usable(cls, [obj])

    @reporting
    def execute(self, context):
        obj = panel_object(context)
        if obj is None:
            raise CubicCraftError("Select a mesh object first")
        values = normal_map_settings.given(self, context.scene)
        with waiting(context.window):
            made = make_normal_map(obj, MapOptions(**values))
        where = "packed" if made.image.packed_file else made.image.filepath
        count = len(mesh_bridge.mesh_of(made.object).polygons)
        done = (
            f'"{made.object.name}" has {count:,} triangles, no farther'
            f' than {made.apart:.2g} from "{obj.name}", which is hidden; "{made.image.name}"'
            f" ({where}) is shown in Material Preview"
        )
        return report_all(self, done, made.problems)
