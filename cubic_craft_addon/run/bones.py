# SPDX-License-Identifier: GPL-3.0-or-later
"""The bones that move a mesh, which say what its limbs are.

An armature may be in any state. What cannot be read is no bone; nothing here raises.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np

from ... import solver
from .. import mesh_bridge
from .object_frame import Placement
from .whole import Whole

if TYPE_CHECKING:
    from ...solver.limbs import KnownLimbs

_DIGITS = 5  # of the places of bones, so that moving mesh and rig together changes no bit
_SAME = 1e-4  # of the rig: bones nearer to each other than that are one


class BonePlaces(NamedTuple):
    """The deform bones of a mesh in the rest pose, as plain values that can be compared."""

    groups: tuple[str, ...]
    """names of the bones and of their vertex groups"""
    ends: tuple[float, ...]
    """x, y, z of the head and of the tail of each, in the coordinates of the mesh"""
    parents: tuple[int, ...]
    """-1 for none"""

    @property
    def arrays(self):
        """Heads (b,3), tails (b,3) and parents (b,)."""
        ends = np.reshape(self.ends, (-1, 2, 3))
        return ends[:, 0], ends[:, 1], np.array(self.parents, dtype=int)

    @property
    def tolerance(self):
        """Distance of bones that are one."""
        return _SAME * float(np.ptp(np.reshape(self.ends, (-1, 3)), axis=0).max())


class Weights(NamedTuple):
    """Those of the vertex groups of bones, k of them that are not 0."""

    vertex: np.ndarray
    """(k,) int"""
    bone: np.ndarray
    """(k,) int"""
    weight: np.ndarray
    """(k,)"""


@dataclass(frozen=True, eq=False)
class Bones:
    """The bones of a mesh with their weights, free of references to Blender's data."""

    places: BonePlaces
    weights: Weights
    whole: Whole
    placed: np.ndarray
    """(N,3) the shape in the rest pose with its images, where the object is solved alone"""
    alone: Placement
    pose: tuple[float, ...] | None = None
    """for each bone, the 16 numbers of the map of the object's coordinates from the rest pose"""

    def is_like(self, other: Bones | None) -> bool:
        """Return whether both have the same bones and weights."""
        return (
            other is not None
            and self.places == other.places
            and all(map(np.array_equal, self.weights, other.weights))
        )

    @cached_property
    def limbs(self) -> KnownLimbs:
        """The limbs in the rest pose, of all vertices (N,), where the object is solved alone."""
        heads, tails, parents = self._all.ends_and_parents
        return solver.limbs_of_bones(
            self.placed,
            self._all.weights,
            self.alone.place(heads),
            self.alone.place(tails),
            parents,
        )

    @cached_property
    def _all(self):
        return _Images(self.places, self.weights, self.whole)

    def limbs_at(self, placement: Placement) -> KnownLimbs:
        """Return the limbs in the present pose, in the coordinates of a placement."""
        limbs, A = self.limbs, self.alone.linear
        if self.pose is not None:
            maps = self._all.of_pose(np.reshape(self.pose, (-1, 4, 4)))[:, :3, :3]
            limbs = limbs.turned(_rotations(A @ maps @ np.linalg.inv(A)))
        if placement.shape_key != self.alone.shape_key:
            U, _, Vt = np.linalg.svd(placement.linear @ np.linalg.inv(A))
            limbs = solver.placed_limbs(limbs, U @ Vt)
        return limbs

    def in_pose(self, pose: tuple[float, ...] | None) -> Bones:
        """Return the same, with the limbs that were found, in another pose."""
        other = replace(self, pose=pose)
        other.__dict__.update({name: getattr(self, name) for name in ("_all", "limbs")})
        return other


def _rotations(maps):
    """Return the rotations nearest to maps (s,3,3)."""
    return solver.svd_rotations(maps.swapaxes(1, 2))


class _Images:
    """Bones with those of the images that a Mirror modifier adds, s of them.

    Attributes
    ----------
    ends_and_parents : tuple
        Heads (s,3), tails (s,3) and parents (s,).
    weights : (N,s) csr_matrix
    """

    def __init__(self, places: BonePlaces, weights: Weights, whole: Whole):
        from scipy.sparse import csr_matrix

        heads, tails, parents = places.arrays
        count = total = len(heads)
        n = int(whole.source.max(initial=-1)) + 1
        own = csr_matrix((weights.weight, (weights.vertex, weights.bone)), shape=(n, count))
        found, blocks = [(heads, tails, parents)], []
        self._maps, self._bone = [np.eye(4)] * count, list(range(count))
        for is_image, matrix in whole.elements():
            images = _moved(heads, matrix), _moved(tails, matrix)
            place = _places_among(heads, tails, images, places.tolerance)
            new = np.flatnonzero(place < 0)
            place[new] = total + np.arange(len(new))
            total += len(new)
            linked = np.where(parents >= 0, place[parents], -1)
            found.append((images[0][new], images[1][new], linked[new]))
            self._maps += [matrix] * len(new)
            self._bone += new.tolist()
            rows = np.flatnonzero(is_image)
            block = own[whole.source[rows]].tocoo()
            blocks.append((block.data, rows[block.row], place[block.col]))
        data, rows, columns = (np.concatenate(part) for part in zip(*blocks, strict=True))
        self.weights = csr_matrix((data, (rows, columns)), shape=(len(whole.source), total))
        self.ends_and_parents = tuple(np.concatenate(part) for part in zip(*found, strict=True))

    def of_pose(self, pose):
        """Return the maps (s,4,4) of a pose of the bones (b,4,4)."""
        return np.array(
            [
                M @ pose[bone] @ np.linalg.inv(M)
                for M, bone in zip(self._maps, self._bone, strict=True)
            ]
        )


def _places_among(heads, tails, images, tolerance):
    """Return the number (b,) of the bone that lies where each image does, or -1."""
    apart = np.abs(images[0][:, None] - heads) + np.abs(images[1][:, None] - tails)
    is_same = apart.max(axis=2) <= tolerance
    own = np.arange(len(heads))
    nearest = np.where(is_same[own, own], own, is_same.argmax(axis=1))
    return np.where(is_same.any(axis=1), nearest, -1)


def _moved(points, matrix):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def bone_places(obj: bpy.types.Object, rigged: bpy.types.Object | None = None) -> BonePlaces | None:
    """Return the places of the deform bones that have a vertex group on a mesh, None for none.

    Parameters
    ----------
    obj
        With the groups.
    rigged : Object, optional
        With the Armature modifier, if it is another one.
    """
    rigged = rigged or obj
    rig = _rig(rigged)
    into = rig and _into(rigged, rig)
    if rig is None or into is None:
        return None
    names = {group.name for group in obj.vertex_groups}
    bones = [bone for bone in _armature(rig).bones if bone.use_deform and bone.name in names]
    ends = np.array([(*bone.head_local, *bone.tail_local) for bone in bones])
    if not len(bones) or not np.isfinite(ends).all():
        return None
    ends = _rounded(_moved(ends.reshape(-1, 2, 3), into))
    number = {bone.name: index for index, bone in enumerate(bones)}
    parents = _by_places([_parent(bone, number) for bone in bones], ends)
    return BonePlaces(tuple(number), tuple(ends.ravel().tolist()), tuple(parents))


def read_bones(
    obj: bpy.types.Object,
    original: np.ndarray,
    whole: Whole,
    alone: Placement,
    known: Bones | None = None,
) -> Bones | None:
    """Read the bones of an object, None if none moves it.

    Parameters
    ----------
    obj
    original : (n,3) array
        Object space.
    whole : Whole
    alone : Placement
        Where the object is solved alone.
    known : Bones, optional
        Of the same shape, placement and weights; what has not changed is reused.
    """
    places = bone_places(obj)
    if places is None:
        return None
    if known is not None and known.places.groups != places.groups:
        known = None
    if known is not None and known.places == places and known.whole is whole:
        return known
    weights = known.weights if known else _read_weights(obj, places.groups)
    if not len(weights.vertex):
        return None
    return Bones(places, weights, whole, alone.place(whole.images(original)), alone)


def read_posed_bones(
    obj: bpy.types.Object,
    original: np.ndarray,
    whole: Whole,
    alone: Placement,
    rigged: bpy.types.Object,
) -> Bones | None:
    """Read the bones of a mesh that has taken over the present pose of another object.

    Parameters
    ----------
    obj, original, whole, alone
        As for `read_bones`; the vertex groups are those of this one.
    rigged : Object
        Whose modifiers the mesh was made with.
    """
    places = bone_places(obj, rigged)
    pose = places and read_pose(rigged, places)
    if places is None or pose is None:
        return None
    weights = _read_weights(obj, places.groups)
    if not len(weights.vertex):
        return None
    at_rest = _unposed(original, weights, np.reshape(pose, (-1, 4, 4)))
    return Bones(places, weights, whole, alone.place(whole.images(at_rest)), alone, pose)


def read_pose(obj: bpy.types.Object, places: BonePlaces) -> tuple[float, ...] | None:
    """Return the present pose of the bones of an object, see `Bones`, or None."""
    rig = _rig(obj)
    into = rig and _into(obj, rig)
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


def _into(obj, rig):
    """Return the matrix (4,4) from the rig's coordinates to the object's, None for none."""
    own = np.array(obj.matrix_world, dtype=np.float64)
    other = np.array(rig.matrix_world, dtype=np.float64)
    if not (np.isfinite(own).all() and np.isfinite(other).all()):
        return None
    if abs(np.linalg.det(own)) < 1e-30 or abs(np.linalg.det(other)) < 1e-30:
        return None
    return np.linalg.inv(own) @ other


def _rounded(ends):
    """Return the ends of bones without their last digits."""
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
    tolerance = _SAME * np.ptp(ends.reshape(-1, 3), axis=0).max()
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
    """Return the Weights of vertex groups."""
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
