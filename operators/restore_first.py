# SPDX-License-Identifier: GPL-3.0-or-later
"""Restore First: return the selected meshes to the original that *From Here* has replaced."""

import bpy

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.handles.baked_pose import remember_pose
from ._shared.originals import for_each_original
from ._shared.selection import poll_any_usable, poll_meshes, selected_meshes
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_restore_first(bpy.types.Operator):
    """Return the selected meshes to their first original."""

    bl_idname = "cubic_craft.restore_first"
    bl_label = "Restore First"
    bl_description = (
        "Restore the shape that the selected meshes had before they were first cubified. Later"
        " originals, which From Here has put in its place, are lost"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is a mesh with a first original."""
        if not poll_meshes(cls, context):
            return False
        objects = [obj for obj in selected_meshes(context) if mesh_bridge.has_first(obj.data)]
        return poll_any_usable(cls, objects, "No original was replaced; Restore brings it back")

    @reporting
    def execute(self, context):
        """Restore each mesh once."""
        return for_each_original(
            self, context, _restore, "Restored the first original of", mesh_bridge.has_first
        )


def _restore(obj):
    remember_pose(obj, is_posed=False)
    mesh_bridge.restore_first(obj)
    return "what was made of it is lost (Ctrl-Z brings it back)"
