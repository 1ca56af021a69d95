# SPDX-License-Identifier: GPL-3.0-or-later
"""What hangs on bones is solved where it is in the rest pose, as the body is that they deform."""

import math

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from rich_mesh import position_of
from rig import ball_with_bones
from scene import cubify, select


def _eye(rig, way, place=(0.0, -0.9, 0.5)):
    """Add a ball that the bone High carries, in the surface of the large one."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, radius=0.3)
    eye = bpy.context.object
    if way == "BONE":
        eye.parent, eye.parent_type, eye.parent_bone = rig, "BONE", "High"
    else:
        constraint = eye.constraints.new(way)
        if way == "ARMATURE":
            constraint = constraint.targets.new()
        constraint.target, constraint.subtarget = rig, "High"
        if way == "CHILD_OF":
            constraint.inverse_matrix = rig.data.bones["High"].matrix_local.inverted()
    bpy.context.view_layer.update()
    eye.matrix_world = Matrix.Translation(place) @ Matrix.Rotation(0.3, 4, "X")
    bpy.context.view_layer.update()
    return eye


def _results(way, bent):
    ball, rig = ball_with_bones()
    ball.cubic_craft.refine = "OFF"
    eye = _eye(rig, way)
    at_rest = np.array(eye.matrix_world)
    rig.pose.bones["High"].rotation_euler.x = bent
    bpy.context.view_layer.update()
    assert (np.abs(np.array(eye.matrix_world) - at_rest).max() > 0.1) == bool(bent)
    select(ball, eye)
    assert cubify(max_iterations=10) == {"FINISHED"}
    return ball, eye, position_of(ball.data), position_of(eye.data)


@pytest.mark.thorough(2)
@pytest.mark.parametrize("way", ["BONE", "CHILD_OF", "ARMATURE"])
def test_a_pose_changes_nothing_of_what_is_solved(way):
    *_, ball, eye = _results(way, 0.0)
    *_, other, posed = _results(way, math.radians(40.0))
    assert np.abs(ball - other).max() < 1e-3 and np.abs(eye - posed).max() < 1e-3


def test_without_a_body_that_bends_the_present_place_counts():
    ball, eye, _, _ = _results("BONE", math.radians(40.0))
    together = position_of(eye.data)
    ball.modifiers["Armature"].show_viewport = False
    select(eye)
    assert cubify(max_iterations=10) == {"FINISHED"}
    assert np.abs(position_of(eye.data) - together).max() > 0.01
