# SPDX-License-Identifier: GPL-3.0-or-later
"""The pose: the handles, and the motion of their targets since they were bound.

A target's *relation* to the object is its matrix in the object's coordinates; B is the relation
when the handle was bound, C is the one now, and the handle's vertices are mapped by M = C B^-1 P,
where P is the handle's own pose (see `own_pose`).

Invariant: M is the same, bit for bit, as long as object and target move together; Live restarts
whenever it changes. The relation of a child is therefore computed from its own transform: its world
matrix has 32-bit rounding errors that depend on the position of the object.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ...solver.errors import CubicCraftError
from ...solver.pieces.handle_pose import IDENTITY
from .. import mesh_bridge
from ..mesh_bridge import vertex_group
from ..object_properties import has_properties, object_properties, users_of
from .handle import Handle
from .own_pose import Pose, check_pose, is_invertible, own_pose

if TYPE_CHECKING:
    from .properties import CubicCraftHandle

_STILL = 1e-6  # relative; smaller motions of a target are ignored
_DIGITS = 5  # of a matrix computed through world space


def object_handles(obj: bpy.types.Object) -> tuple[Handle, ...]:
    """Return the handles of the object in their current pose; none while they are disabled.

    Raises CubicCraftError: as `posed_handles`.
    """
    return posed_handles(obj) if object_properties(obj).use_handles else ()


def posed_handles(
    obj: bpy.types.Object, poses: Mapping[int, Pose] | None = None
) -> tuple[Handle, ...]:
    """Return the handles of the object in their current pose, even while they are disabled.

    It is cheap: it reads no vertices. If its target was deleted, a handle only has its own pose.

    `poses`: mapping of int to Pose, optional, instead of the own poses of the handles with these
    numbers (`identify`). Raises CubicCraftError: a vertex group is missing, or a target or the
    object has an invalid transform; the message names the object and the remedy.
    """
    return tuple(
        Handle(
            _group(obj, number, item),
            threshold=item.threshold,
            is_cubic=item.is_cubic,
            matrix=_matrix(obj, item, (poses or {}).get(item.uid) or own_pose(item)),
        )
        for number, item in enumerate(object_properties(obj).handles, start=1)
    )


def bind(obj: bpy.types.Object, handle: CubicCraftHandle) -> None:
    """Make the current transform of the target the one in which nothing moves.

    If the transform of the object or the target is invalid, the handle gets no target.
    """
    target = handle.target
    object_properties(target).is_target = True
    parent = target.parent
    handle.is_foreign = parent is not None and parent != obj and parent.type == "MESH"
    if target == obj:
        return  # refused when it is used, so that the panel can show it
    bpy.context.view_layer.update()
    try:
        matrix, _ = _relation(obj, handle)
        _check_invertible(matrix, obj, target)
    except CubicCraftError:
        handle.target = None
    else:
        handle.rest = handle.baked = Matrix(matrix.tolist())


def reset(obj: bpy.types.Object, handle: CubicCraftHandle) -> None:
    """Put the target back to where it was when it was bound."""
    target = handle.target
    reference = _reference(obj, handle)
    if _is_plain_child(target, reference):
        target.matrix_basis = target.matrix_parent_inverse.inverted_safe() @ handle.rest
    else:
        target.matrix_world = reference.matrix_world @ handle.rest


def live_target(handle: CubicCraftHandle) -> bpy.types.Object | None:
    """Return the object that the handle follows; None if it is pinned, or the target was deleted.

    The handle itself keeps a deleted object in the file, but no scene uses it.
    """
    target = handle.target if handle.mode == "FOLLOW" else None
    return target if target is not None and _is_in_a_scene(target) else None


def followed(obj: bpy.types.Object) -> Iterator[tuple[CubicCraftHandle, bpy.types.Object]]:
    """Yield each handle of the object that follows something, with its target."""
    for handle in object_properties(obj).handles:
        target = live_target(handle)
        if target is not None:
            yield handle, target


def _group(obj, number, handle):
    if not handle.group:
        raise CubicCraftError(
            f'handle {number} of "{obj.name}" has no vertex group; pick one or remove the handle'
        )
    return vertex_group(obj, handle.group).name


def _matrix(obj, handle, pose):
    """Return M as 16 numbers, row by row."""
    check_pose(obj, handle, pose)
    motion = _motion(obj, handle)
    if IDENTITY in (motion, pose):
        return pose if motion == IDENTITY else motion
    return tuple((np.reshape(motion, (4, 4)) @ np.reshape(pose, (4, 4))).ravel().tolist())


def _motion(obj, handle):
    """Return the motion of the target, C B^-1, as 16 numbers, row by row."""
    target = live_target(handle)
    if target is None:
        return IDENTITY
    if target == obj:
        raise CubicCraftError(
            f'a handle of "{obj.name}" follows the object itself; pick another target'
        )
    now, noise = _relation(obj, handle)
    rest = np.array(handle.rest, dtype=np.float64)
    for matrix in (rest, now):
        _check_invertible(matrix, obj, target)
    matrix = now @ np.linalg.inv(rest)
    size = max(noise, np.abs(now[:3, 3]).max(), np.abs(rest[:3, 3]).max())
    off = np.abs(matrix - np.eye(4))
    if off[:3, :3].max() <= _STILL and off[:3, 3].max() <= _STILL * size:
        return IDENTITY
    if noise > 0.0:
        _round(matrix[:3, :3], np.abs(matrix[:3, :3]).max())
        _round(matrix[:3, 3], size)
    return tuple(matrix.ravel().tolist())


def _relation(obj, handle):
    """Return the relation (4,4), and the size whose last bits may be wrong in it, 0 if none.

    Raises CubicCraftError: the object has an invalid transform.
    """
    target = handle.target
    reference = _reference(obj, handle)
    if _is_plain_child(target, reference):
        own, inverse = (
            np.array(matrix, dtype=np.float64)
            for matrix in (target.matrix_basis, target.matrix_parent_inverse)
        )
        return inverse @ own, 0.0
    world = np.array(reference.matrix_world, dtype=np.float64)
    _check_invertible(world, reference, reference)
    place = np.array(target.matrix_world, dtype=np.float64)
    if not np.isfinite(place).all():
        return place, 0.0
    distance = max(np.abs(world[:3, 3]).max(), np.abs(place[:3, 3]).max())
    into_object = np.linalg.inv(world)
    noise = distance * np.abs(into_object[:3, :3]).max()
    return into_object @ place, max(noise, 1e-30)


def _reference(obj, handle):
    """Return the object to which the target is related.

    A copy of an object has handles with the same targets, which are children of the original. They
    define the pose of both, wherever the copy is.
    """
    parent = handle.target.parent
    if handle.is_foreign or parent is None or parent == obj:
        return obj
    if parent.type != "MESH" or not has_properties(parent):
        return obj
    is_handle_there = any(h.target == handle.target for h in object_properties(parent).handles)
    return parent if is_handle_there else obj


def _is_plain_child(target, reference):
    """Return whether the target's own transform alone determines its place on the reference."""
    return (
        target.parent == reference
        and target.parent_type == "OBJECT"
        and target.rigid_body is None
        and not any(not c.mute and c.influence > 0.0 for c in target.constraints)
    )


def _is_in_a_scene(target):
    for scene in bpy.data.scenes:
        found = scene.objects.get(target.name)
        # Another object of that name may come from a library.
        if found == target or (found is not None and target in tuple(scene.objects)):
            return True
    return False


def _check_invertible(matrix, obj, target):
    if is_invertible(matrix):
        return
    whose = "it" if target == obj else f'"{target.name}"'
    raise CubicCraftError(
        f'the handles of "{obj.name}" cannot be posed, because {whose} has a scale of zero or'
        " a transform that is not finite; clear it (Alt-S)"
    )


def _round(values, size):
    """Drop the last digits of the values, in place."""
    unit = 10.0 ** (math.floor(math.log10(size)) - _DIGITS)
    values[...] = np.round(values / unit) * unit


def remember_pose(obj: bpy.types.Object, *, is_posed: bool) -> None:
    """Store the pose with which the mesh of the object has just been written.

    When that shape becomes the original, by Apply or an edit by hand, this pose becomes the rest:
    the next Cubify would move the vertices, which are at their targets, by the same way again.

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
                now = Matrix(_relation(user, handle)[0].tolist()) if is_led else handle.rest
                handle.baked, handle.baked_pose = now, handle.pose


def rest_in_pose(mesh: bpy.types.Mesh) -> None:
    """Make the pose of the written mesh the rest, because its shape is now the original."""
    for user in _users(mesh):
        for handle in object_properties(user).handles:
            if handle.is_baked:
                handle.rest = handle.baked
                is_same = handle.pose == handle.baked_pose  # bit for bit
                since = Matrix() if is_same else handle.pose @ handle.baked_pose.inverted_safe()
                handle.pose = since
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
    is_posed = own_pose(handle) != IDENTITY
    return is_posed and handle.group == other.group and handle.pose == other.pose


def _users(mesh):
    return filter(has_properties, users_of([mesh]))
