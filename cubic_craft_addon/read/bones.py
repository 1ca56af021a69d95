# SPDX-License-Identifier: GPL-3.0-or-later
"""Read the bones that move a mesh, which say what its limbs are.

An armature may be in any state. What cannot be read is no bone; nothing here raises.
"""

import bpy
import numpy as np

from ...solver.pieces.bones import SAME, BonePlaces, Bones, Weights, moved
from ...solver.pieces.placement import Placement
from ...solver.pieces.whole import Whole
from .. import mesh_bridge
from .reflections import matrix_between

_DIGITS = 5  # of the places of bones, so that moving mesh and rig together changes no bit


def bone_places(obj: bpy.types.Object, rigged: bpy.types.Object | None = None) -> BonePlaces | None:
    """Return the places of the deform bones that have a vertex group on a mesh, None for none.

    `obj`: with the groups. `rigged`: Object, optional, with the Armature modifier, if it is another
    one.
    """
    rigged = rigged or obj
    rig = _rig(rigged)
    into = rig and matrix_between(rig, rigged)
    if rig is None or into is None:
        return None
    names = {group.name for group in obj.vertex_groups}
    bones = [bone for bone in _armature(rig).bones if bone.use_deform and bone.name in names]
    ends = np.array([(*bone.head_local, *bone.tail_local) for bone in bones])
    if not len(bones) or not np.isfinite(ends).all():
        return None
    ends = _rounded(moved(ends.reshape(-1, 2, 3), into))
    number = {bone.name: index for index, bone in enumerate(bones)}
    parents = _by_places([_parent(bone, number) for bone in bones], ends)
    return BonePlaces(tuple(number), tuple(ends.ravel().tolist()), tuple(parents))


def read_bones(
    obj: bpy.types.Object,
    original: np.ndarray,
    whole: Whole,
    alone: Placement,
    known: Bones | None = None,
    rigged: bpy.types.Object | None = None,
) -> Bones | None:
    """Read the bones of an object, None if none moves it.

    `original`: (n,3), object space. `alone`: where the object is solved alone. `known`: Bones,
    optional, of the same shape, placement and weights; what has not changed is reused. `rigged`:
    Object, optional, whose modifiers the mesh was made with, and whose present pose it has.
    """
    places = bone_places(obj, rigged)
    if places is None:
        return None
    if known is not None and known.places.groups != places.groups:
        known = None
    if known is not None and known.places == places and known.whole is whole:
        return known
    pose = read_pose(rigged, places) if rigged is not None else None
    if rigged is not None and pose is None:
        return None
    weights = known.weights if known else _read_weights(obj, places.groups)
    if not len(weights.vertex):
        return None
    if pose is not None:
        original = _unposed(original, weights, np.reshape(pose, (-1, 4, 4)))
    return Bones(places, weights, whole, alone.place(whole.images(original)), alone, pose)


def read_pose(obj: bpy.types.Object, places: BonePlaces) -> tuple[float, ...] | None:
    """Return the present pose of the bones of an object, see `Bones`, or None."""
    rig = _rig(obj)
    into = rig and matrix_between(rig, obj)
    if rig is None or into is None:
        return None
    pose = rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose
    maps = []
    for name in places.groups:
        bone, rest = pose and pose.bones.get(name), _armature(rig).bones.get(name)
        if bone is None or rest is None:
            return None
        maps.append(np.array(bone.matrix @ rest.matrix_local.inverted_safe(), dtype=np.float64))
    maps = into @ np.array(maps) @ np.linalg.inv(into)
    if not np.isfinite(maps).all() or np.abs(np.linalg.det(maps)).min() < 1e-12:
        return None
    return tuple(np.round(maps, _DIGITS).ravel().tolist())


def _unposed(points, weights, pose):
    """Return about where points (n,3) were in the rest pose, by weights and a pose (b,4,4)."""
    count, total = len(points), np.bincount(weights.vertex, weights.weight, len(points))
    back = np.linalg.inv(pose)[weights.bone]
    there = np.einsum("kij,kj->ki", back[:, :3, :3], points[weights.vertex]) + back[:, :3, 3]
    sums = [np.bincount(weights.vertex, weights.weight * x, count) for x in there.T]
    is_moved = total > 0.0
    means = np.stack(sums, axis=1) / np.where(is_moved, total, 1.0)[:, None]
    return np.where(is_moved[:, None], means, points)


def _rig(obj):
    """Return the object of the first Armature modifier that moves vertices by their groups."""
    for modifier in obj.modifiers:
        if not isinstance(modifier, bpy.types.ArmatureModifier) or not modifier.show_viewport:
            continue
        rig = modifier.object
        if modifier.use_vertex_groups and rig is not None and rig.type == "ARMATURE":
            return rig
    return None


def _armature(rig):
    assert isinstance(rig.data, bpy.types.Armature)
    return rig.data


def _rounded(ends):
    size = np.abs(ends).max()
    if size == 0.0:
        return ends
    unit = 10.0 ** (np.floor(np.log10(size)) - _DIGITS)
    return np.round(ends / unit) * unit + 0.0  # no negative zeros


def _parent(bone, number):
    """Return the number of the nearest ancestor that has one, or -1."""
    ancestor = bone.parent
    while ancestor is not None and ancestor.name not in number:
        ancestor = ancestor.parent
    return -1 if ancestor is None else number[ancestor.name]


def _by_places(parents, ends):
    """Return the parents; of a bone without one, the bone at whose tail it begins.

    In rigs made by Rigify, the bones that deform hang on others that do not.
    """
    heads, tails = ends[:, 0], ends[:, 1]
    tolerance = SAME * np.ptp(ends.reshape(-1, 3), axis=0).max()
    found = list(parents)
    for bone in np.flatnonzero(np.array(parents) < 0).tolist():
        distance = np.linalg.norm(tails - heads[bone], axis=1)
        nearest = int(distance.argmin())
        if distance[nearest] > tolerance:
            continue
        ancestor = nearest
        while ancestor >= 0 and ancestor != bone:
            ancestor = found[ancestor]
        if ancestor < 0:  # not a ring
            found[bone] = nearest
    return found


def _read_weights(obj, groups):
    number_of = {name: number for number, name in enumerate(groups)}
    bone_of = {
        group.index: number_of[group.name] for group in obj.vertex_groups if group.name in number_of
    }
    found = [
        (vertex.index, bone_of[element.group], element.weight)
        for vertex in mesh_bridge.mesh_of(obj).vertices  # see `mesh_bridge.group_weights`
        for element in vertex.groups
        if element.group in bone_of
    ]
    vertex, bone, weight = zip(*found, strict=True) if found else ((), (), ())
    return Weights(np.array(vertex, dtype=int), np.array(bone, dtype=int), np.array(weight))
