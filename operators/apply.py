# SPDX-License-Identifier: GPL-3.0-or-later
"""Apply: keep the cubic shape permanently and discard the original."""

import bpy

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.handles.baked_pose import rest_in_pose
from ._shared.originals import for_each_original, poll_originals
from ._shared.selection import poll_meshes
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_apply(bpy.types.Operator):
    """Keep the cubic shape permanently and discard the original."""

    bl_idname = "cubic_craft.apply"
    bl_label = "Apply"
    bl_description = "Keep the cubic shape permanently and discard the original"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is a mesh with an original."""
        return poll_meshes(cls, context) and poll_originals(cls, context)

    @reporting
    def execute(self, context):
        """Discard the original of each mesh once."""
        return for_each_original(self, context, _apply, "Applied")


def _apply(obj):
    rest_in_pose(obj.data)
    mesh_bridge.discard_original(obj.data)
    return ""
