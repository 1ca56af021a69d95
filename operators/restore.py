# SPDX-License-Identifier: GPL-3.0-or-later
"""Restore: return the selected meshes to their original shape, bit for bit."""

import bpy

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.handles.baked_pose import remember_pose
from ._shared.originals import for_each_original, poll_originals
from ._shared.selection import poll_meshes
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_restore(bpy.types.Operator):
    """Return the selected meshes to their original shape."""

    bl_idname = "cubic_craft.restore"
    bl_label = "Restore"
    bl_description = (
        "Restore the shape that the selected meshes had before Cubify. Changes made by hand since"
        " are lost"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is a mesh with an original."""
        return poll_meshes(cls, context) and poll_originals(cls, context)

    @reporting
    def execute(self, context):
        """Restore each mesh once."""
        return for_each_original(self, context, _restore, "Restored")


def _restore(obj):
    was_edited = mesh_bridge.is_edited(obj.data) or mesh_bridge.has_strokes(obj.data)
    remember_pose(obj, is_posed=False)
    mesh_bridge.restore(obj)
    return "edits made by hand are lost (Ctrl-Z brings them back)" if was_edited else ""
