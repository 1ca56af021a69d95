# SPDX-License-Identifier: GPL-3.0-or-later
"""From the target of a handle to the mesh that it poses.

An artist who moves a handle has its empty selected, not the mesh, but the buttons should still act
on the mesh.

(The result is an object whose data is a mesh, which bpy's type stubs cannot express.)
"""

from typing import Any

import bpy

from ..object_properties import has_properties, object_properties


def posed_mesh(context: bpy.types.Context, target: bpy.types.Object) -> Any:
    """Return the mesh object with a handle that follows the target, None if there is none.

    It is cheap for objects that are not targets, because it runs at every redraw.
    """
    if not has_properties(target) or not object_properties(target).is_target:
        return None
    parent = target.parent
    if parent is not None and _follows(parent, target):
        return parent
    return next((obj for obj in context.view_layer.objects if _follows(obj, target)), None)


def panel_object(context: bpy.types.Context) -> Any:
    """Return the mesh object that the panel shows: the active one, or the one it poses."""
    active = context.active_object
    if active is None or active.type == "MESH":
        return active
    return posed_mesh(context, active)


def _follows(obj, target):
    if obj.type != "MESH" or not has_properties(obj):
        return False
    handles = object_properties(obj).handles
    return any(handle.mode == "FOLLOW" and handle.target == target for handle in handles)
