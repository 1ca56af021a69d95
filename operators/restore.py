# SPDX-License-Identifier: GPL-3.0-or-later
"""Restore: return the selected meshes to their original shape, or to the first one."""

import bpy

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.handles.pose import remember_pose
from ._shared.originals import OnOriginals


class CUBIC_CRAFT_OT_restore(OnOriginals, bpy.types.Operator):
    bl_idname = "cubic_craft.restore"
    bl_label = "Restore"
    bl_description = (
        "Restore the shape that the selected meshes had before Cubify. Changes made by hand since"
        " are lost"
    )
    done = "Restored"

    def change(self, obj):
        """Restore the original."""
        was_edited = mesh_bridge.is_edited(obj.data) or mesh_bridge.has_strokes(obj.data)
        remember_pose(obj, is_posed=False)
        mesh_bridge.restore(obj)
        return "edits made by hand are lost (Ctrl-Z brings them back)" if was_edited else ""


class CUBIC_CRAFT_OT_restore_first(OnOriginals, bpy.types.Operator):
    bl_idname = "cubic_craft.restore_first"
    bl_label = "Restore First"
    bl_description = (
        "Restore the shape that the selected meshes had before they were first cubified. Later"
        " originals, made by From Here, are lost"
    )
    done = "Restored the first original of"
    nothing = "No original was replaced; Restore brings it back"
    is_meant = staticmethod(mesh_bridge.has_first)

    def change(self, obj):
        """Restore the first original."""
        remember_pose(obj, is_posed=False)
        mesh_bridge.restore_first(obj)
        return "what was made of it is lost (Ctrl-Z brings it back)"
