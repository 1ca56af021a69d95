# SPDX-License-Identifier: GPL-3.0-or-later
"""Shade Edges Sharp: show the straight edges of crisp shapes as what they are."""

import bpy

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.ui import seen
from ._shared.selection import poll_work, refuse, selected_meshes
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_shade_edges(bpy.types.Operator):
    """Mark the straight edges of crisp shapes as sharp, or no longer."""

    bl_idname = "cubic_craft.shade_edges"
    bl_label = "Shade Edges Sharp"
    bl_description = (
        "Mark edges that turn by more than 30 degrees as sharp, as smooth shading makes them look"
        " round. The marks follow the shape; Restore takes them back, and so does another click"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """There is a crisp shape without other sharp edges."""
        if not poll_work(cls, context):
            return False
        return bool(_shaded(context)) or refuse(cls, "No crisp shape is shaded smooth all over")

    @reporting
    def execute(self, context):
        """Do for all what the first does not have."""
        meshes = _shaded(context)
        is_on = mesh_bridge.has_following_edges(meshes[0])
        for mesh in meshes:
            if is_on:
                mesh_bridge.forget_edges(mesh)
            else:
                mesh_bridge.let_edges_follow(mesh)
        return {"FINISHED"}


def _shaded(context):
    return list(dict.fromkeys(obj.data for obj in selected_meshes(context) if seen.is_rounded(obj)))
