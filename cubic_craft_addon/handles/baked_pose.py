# SPDX-License-Identifier: GPL-3.0-or-later
"""When the posed shape becomes the original, its pose becomes the rest.

Apply makes the posed shape the original, and so does an edit by hand. The next Cubify starts from
that shape, in which the vertices are already at their targets; without a new rest, it would move
them by the same displacement again. Each handle therefore stores the relation of its target (see
`pose`) and its own pose from when the mesh was last written.
"""

from collections.abc import Callable

import bpy
from mathutils import Matrix

from .. import mesh_bridge
from ..object_properties import has_properties, object_properties
from .own_pose import has_pose, pose_since_baked
from .pose import live_target, relation


def remember_pose(obj: bpy.types.Object, *, is_posed: bool) -> None:
    """Store the pose with which the mesh of the object has just been written.

    `is_posed`: the mesh itself has been written, with the object's own handles.
    """
    mesh = mesh_bridge.mesh_of(obj)
    users = _users(mesh) if mesh.users > 1 else [obj]
    written = list(object_properties(obj).handles) if is_posed else []
    for user in users:
        for handle in object_properties(user).handles:
            handle.is_baked = any(_is_as(handle, other) for other in written)
            if handle.is_baked:
                is_led = live_target(handle) is not None
                now = Matrix(relation(user, handle).tolist()) if is_led else handle.rest
                handle.baked, handle.baked_pose = now, handle.pose


def rest_in_pose(mesh: bpy.types.Mesh) -> None:
    """Make the pose of the written mesh the rest, because its shape is now the original."""
    for user in _users(mesh):
        for handle in object_properties(user).handles:
            if handle.is_baked:
                handle.rest = handle.baked
                handle.pose = pose_since_baked(handle)
                handle.is_baked = False


def rebase_edited_handles(
    objects: list[bpy.types.Object], start_of: Callable[[bpy.types.Object], mesh_bridge.Start]
) -> None:
    """Do this for each mesh object that starts from its current shape, edited since written."""
    for obj in objects:
        mesh = mesh_bridge.mesh_of(obj)
        is_baked = any(handle.is_baked for handle in object_properties(obj).handles)
        if is_baked and mesh_bridge.starts_here(mesh, start_of(obj)):
            rest_in_pose(mesh)


def _is_as(handle, other):
    """Return whether a handle moves vertices like the other, with which the mesh was written."""
    target = live_target(handle)
    if target is not None or live_target(other) is not None:
        return target == live_target(other)
    return has_pose(handle) and handle.group == other.group and handle.pose == other.pose


def _users(mesh):
    """Return the objects with handles that use the mesh."""
    users = bpy.data.user_map(subset=[mesh])[mesh]
    return [
        user
        for user in users
        if isinstance(user, bpy.types.Object) and user.is_editable and has_properties(user)
    ]
