# SPDX-License-Identifier: GPL-3.0-or-later
"""Reset Pose: return the handles and their targets to where nothing moves."""

import bpy

from ..cubic_craft_addon import live
from ..cubic_craft_addon.handles.own_pose import set_own_pose
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.handles.pose import followed, reset
from ..cubic_craft_addon.object_properties import object_properties
from ..solver.pieces.handle_pose import IDENTITY
from ._shared.selection import poll_mesh, refuse


class CUBIC_CRAFT_OT_handle_reset_pose(bpy.types.Operator):
    bl_idname = "cubic_craft.handle_reset_pose"
    bl_label = "Reset Pose"
    bl_description = (
        "Return the handles, and the objects they follow, to their initial positions; the next"
        " Cubify then leaves the vertices of the handles in place"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not poll_mesh(cls, context):
            return False
        obj = panel_object(context)
        if not _posed(obj) and not any(True for _ in followed(obj)):
            return refuse(cls, "No handle is posed or follows anything")
        return True

    def execute(self, context):
        obj = panel_object(context)
        is_moved = False
        for handle, target in followed(obj):
            if target != obj:
                reset(obj, handle)
                is_moved = True
        if live.current() is not None:
            live.reset_poses(obj)
            # Live undoes its poses itself; an undo step would come before them.
            return {"FINISHED"} if is_moved else {"CANCELLED"}
        for handle in _posed(obj):
            set_own_pose(handle, IDENTITY)
        return {"FINISHED"}


def _posed(obj):
    return [h for h in object_properties(obj).handles if live.pose_of(obj, h) != IDENTITY]
