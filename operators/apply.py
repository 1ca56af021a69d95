# SPDX-License-Identifier: GPL-3.0-or-later
"""Apply: keep the cubic shape permanently and discard the original."""

import bpy

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.handles.pose import rest_in_pose
from ._shared.originals import OnOriginals


class CUBIC_CRAFT_OT_apply(OnOriginals, bpy.types.Operator):
    bl_idname = "cubic_craft.apply"
    bl_label = "Apply"
    bl_description = "Keep the cubic shape permanently and discard the original"
    done = "Applied"

    def change(self, obj):
        """Discard the original."""
        rest_in_pose(obj.data)
        mesh_bridge.discard_original(obj.data)
        return ""
