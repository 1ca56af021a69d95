# SPDX-License-Identifier: GPL-3.0-or-later
"""From the coordinates of an object to its visible shape, and to the frame of the form."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import math
from dataclasses import replace

import bpy
import numpy as np
from mathutils import Euler, Matrix

from ... import solver
from ...solver import CubicCraftError
from ...solver.pieces.placement import Placement, polar
from ...solver.styles.cube import proper
from ...solver.styles.style import Style
from ..form.body import form_of
from ..settings.values import Settings

_SAME = 1e-6  # of the elements of a matrix: less is a pose at rest
_CARRYING = {"ARMATURE", "CHILD_OF", "COPY_TRANSFORMS"}
_SMALLEST_STRETCH = 1e-4  # relative; flatter objects are solved unscaled
_DIGITS = 5  # of the stretch; the world matrix is made of 32 bit numbers
_SMALLEST_TURN = 1e-6  # radians; smaller rotations of the cube are ignored


def _carried_back(obj):
    """Return the matrix (4,4) in the world from the present pose of the bones that carry an object.

    It leads to the one at rest; nowhere if none does, if no visible mesh of the scene is deformed
    by those bones, which then have no rest pose to be seen in, and for objects in no scene: these
    are ours, and have the shape that is seen in the present pose (see `mesh_bridge.make_seen`).
    """
    back = Matrix()
    if not obj.users_scene:
        return back
    while obj is not None:
        for rig, name in _bones(obj):
            bone = rig.pose.bones[name]
            into = rig.matrix_world @ bone.bone.matrix_local @ bone.matrix.inverted_safe()
            moved = into @ rig.matrix_world.inverted_safe()
            if _is_deforming(rig) and np.abs(np.array(moved) - np.eye(4)).max() > _SAME:
                back = moved @ back
        obj = obj.parent
    return back


def _bones(obj):
    """Yield the armatures and the names of their bones that carry an object wholly."""
    if obj.parent_type == "BONE":
        yield from _named(obj.parent, obj.parent_bone)
    for constraint in obj.constraints:
        if constraint.type not in _CARRYING or constraint.mute or constraint.influence < 1.0:
            continue
        targets = constraint.targets if constraint.type == "ARMATURE" else [constraint]
        if len(targets) == 1:
            yield from _named(targets[0].target, targets[0].subtarget)


def _named(rig, name):
    if rig is not None and rig.type == "ARMATURE" and rig.pose and name in rig.pose.bones:
        yield rig, name


def _is_deforming(rig):
    """Return whether a visible mesh is deformed by an armature."""
    return any(
        modifier.type == "ARMATURE" and modifier.object == rig and modifier.show_viewport
        for obj in bpy.context.scene.objects
        if obj.type == "MESH"
        for modifier in obj.modifiers
    )


def placements(
    obj: bpy.types.Object, settings: Settings, *, is_posed: bool = False
) -> tuple[Placement, Placement | None]:
    """Return the placements of an object that is solved alone, and in world space.

    The bones that carry it are at rest, or in their present pose.

    The second is None for an object that is scaled flat: it is solved without its scale, and
    would be in the wrong place beside others.

    Raises CubicCraftError: as `stretch_and_orientation`, and as `form_of`.
    """
    alone = placement_alone(obj, settings, is_posed=is_posed)
    return alone, _in_world(obj, _world(obj, is_posed), settings, alone)


def placement_alone(
    obj: bpy.types.Object, settings: Settings, *, is_posed: bool = False
) -> Placement:
    """Return the placement of an object that is solved alone: its coordinates, stretched.

    Raises CubicCraftError: as `stretch_and_orientation`.
    """
    turn, stretch = _turn_and_stretch(_world(obj, is_posed))
    styles = tuple(_style(obj, one, turn) for one in _all(settings))
    return Placement(stretch, np.zeros(3), np.eye(3), stretch, turn[2], styles)


def _world(obj, is_posed=False):
    """Return the matrix of an object to the world, with what carries it at rest or as it is posed.

    Raises CubicCraftError: its scale or rotation is not finite.
    """
    world = obj.matrix_world if is_posed else _carried_back(obj) @ obj.matrix_world
    if not np.isfinite(np.array(world.to_3x3())).all():
        raise CubicCraftError(f'"{obj.name}" has a scale or rotation that is not finite; clear it')
    return world


def _in_world(obj, world, settings, alone):
    matrix = np.array(world, dtype=np.float64)
    linear, offset = np.ascontiguousarray(matrix[:3, :3]), matrix[:3, 3].copy()
    turn, stretch = _turn_and_stretch(world)
    if _is_flat(linear) or not np.isfinite(offset).all():
        return None
    styles = tuple(
        replace(style, orientation=_orientation(obj, one, turn, turn.T, style.form))
        for one, style in zip(_all(settings), alone.styles, strict=True)
    )
    up = np.array([0.0, 0.0, 1.0])
    return Placement(linear, offset, turn, stretch, up, styles)


def _all(settings):
    """Return the settings of an object, and those with which each of its regions is turned."""
    return [settings, *(settings.of_region(region) for region in settings.regions)]


def _style(obj, settings, turn):
    form = form_of(settings)
    orientation = _orientation(obj, settings, turn, None, form)
    return Style(
        settings.cubeness,
        orientation,
        form,
        crispness=settings.crispness,
        detail_strength=settings.detail_strength,
    )


def _orientation(obj, settings, turn, into, form):
    """Return the orientation of a form; `into` leads back from another place."""
    orientation = _axes(settings).T @ _into_space(obj, settings, turn)
    if into is not None:
        orientation = orientation @ into
    return _simplest(orientation, form is None)


def stretch_and_orientation(obj: bpy.types.Object, settings: Settings):
    """Return the object's stretch and the orientation of the cube.

    The world matrix of the object, W = T S, is split (polar decomposition) into a rotation or
    mirroring T and a symmetric stretch S. The mesh is solved as it is seen, that is with positions
    S v, and the cube's frame is given in the same coordinates. So an object scaled flat becomes as
    cubic as the same mesh modeled flat.

    Returns `stretch`: (3,3), S, invertible; `orientation`: (3,3), the rotation Q that maps
    stretched object coordinates into the form's frame; a reflection for a mirrored object. Raises
    CubicCraftError: the space is FRAME and no frame object is set, or the object's matrix is not
    finite.
    """
    turn, stretch = _turn_and_stretch(_world(obj))
    return stretch, _axes(settings).T @ _into_space(obj, settings, turn)


def world_axes(obj: bpy.types.Object, settings: Settings):
    """Return the axes of the cube in world space, as the columns of a (3,3) array.

    Those of a mirrored object, which the angles are relative to, are left-handed.

    Raises CubicCraftError: as `stretch_and_orientation`.
    """
    turn, _ = _turn_and_stretch(_world(obj))
    return turn @ _into_space(obj, settings, turn).T @ _axes(settings)


def axes_of_angles(obj: bpy.types.Object, settings: Settings) -> np.ndarray:
    """Return the matrix (3,3) from stretched object coordinates to the axes of the angles.

    A reflection for a mirrored object.

    Raises CubicCraftError: as `stretch_and_orientation`.
    """
    return _into_space(obj, settings, _turn_and_stretch(_world(obj))[0])


def angles_of(obj: bpy.types.Object, settings: Settings, orientation):
    """Return the Euler angles (radians) that give the orientation of a cube.

    Of the 24 equivalent rotations of a cube, these are the smallest.
    """
    turn, _ = _turn_and_stretch(_world(obj))
    axes = proper(_into_space(obj, settings, turn) @ orientation.T)
    return Matrix(solver.nearest_to_identity(axes.T).T.tolist()).to_euler()


def check_frame(obj: bpy.types.Object, settings: Settings) -> None:
    """Refuse a space that is that of another object if none is set.

    Raises CubicCraftError: none is set.
    """
    if settings.space == "FRAME" and settings.frame is None:
        raise CubicCraftError(
            f'"{obj.name}" takes its orientation from a frame object, but none is set;'
            " pick one or choose another space"
        )


def _turn_and_stretch(world):
    linear = np.array(world.to_3x3(), dtype=np.float64)
    if _is_flat(linear):
        return np.array(world.to_quaternion().to_matrix(), dtype=np.float64), np.eye(3)
    turn, stretch = polar(linear)
    return turn, _rounded(stretch)


def _is_flat(world):
    sizes = np.linalg.svd(world, compute_uv=False)
    return not sizes[-1] > _SMALLEST_STRETCH * max(sizes[0], 1e-30)


def _axes(settings):
    return np.array(Euler(settings.orientation).to_matrix(), dtype=np.float64)


def _rounded(stretch):
    """Drop the last digits, so that rotating the object keeps the stretch bit for bit."""
    unit = 10.0 ** (math.floor(math.log10(np.abs(stretch).max())) - _DIGITS)
    return np.round(stretch / unit) * unit + 0.0  # no negative zeros


def _into_space(obj, settings, turn):
    """Return the matrix from stretched object coordinates to the axes of the angles."""
    if settings.space == "OBJECT":
        return np.eye(3)
    if settings.space == "WORLD":
        return turn
    check_frame(obj, settings)
    frame = settings.frame.matrix_world.to_quaternion().to_matrix()
    return np.array(frame, dtype=np.float64).T @ turn


def _simplest(orientation, is_plain_cube):
    """Return the rotation that is equivalent for a cube, and the identity where it does nothing.

    An object that is rotated by a right angle, as is common for imported files, or mirrored then
    gives the same bits as one that is not. Other forms are mirrored as they are.
    """
    same = np.eye(3)
    if is_plain_cube:
        orientation = proper(orientation)
        same = np.round(orientation)
    is_like = np.allclose(orientation, same, rtol=0.0, atol=_SMALLEST_TURN)
    return np.eye(3) if is_like else orientation
