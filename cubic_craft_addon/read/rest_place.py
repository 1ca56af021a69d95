# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an object is while the bones that carry it are at rest.

A mesh with an Armature modifier is solved in the rest pose. Its eyes and its hat, which hang on
bones, have to be where they are in that pose, not where the present one has carried them.
"""

import bpy
import numpy as np
from mathutils import Matrix

_SAME = 1e-6  # of the elements of a matrix: less is a pose at rest
_CARRYING = {"ARMATURE", "CHILD_OF", "COPY_TRANSFORMS"}


def world_at_rest(obj: bpy.types.Object) -> Matrix:
    """Return the matrix of an object to the world, with the bones that carry it at rest.

    It is `matrix_world` if none does, if no visible mesh of the scene is deformed by those bones,
    which then have no rest pose to be seen in, and for objects in no scene: these are ours, and
    have the shape that is seen in the present pose (see `mesh_bridge.make_seen`).
    """
    return _carried_back(obj) @ obj.matrix_world


def _carried_back(obj):
    """Return the matrix (4,4) in the world from the present pose to the one at rest."""
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
