# SPDX-License-Identifier: GPL-3.0-or-later
"""A result whose pose became its rest pose: *Cubify* and the panel offer From Here."""

import bpy
import pytest
from rig import ball_with_bones
from scene import cubify, reports_of, select

WORDS = "choose From Here"


@pytest.fixture
def is_posed_anew(part):
    return part("run.posed_anew").is_posed_anew


def apply_pose(ball, rig, bone="High"):
    """Do what *Apply Pose as Rest Pose* takes: bake the pose, and bind the mesh to it."""
    rig.pose.bones[bone].rotation_mode = "XYZ"
    rig.pose.bones[bone].rotation_euler.x = 0.8
    bpy.context.view_layer.update()
    select(ball)
    bpy.ops.object.modifier_apply(modifier="Armature")
    select(rig)
    bpy.ops.object.mode_set(mode="POSE")
    bpy.ops.pose.armature_apply()
    bpy.ops.object.mode_set(mode="OBJECT")
    select(ball)
    ball.modifiers.new("Armature", "ARMATURE").object = rig
    bpy.context.view_layer.update()


@pytest.mark.parametrize("bone", ["Low", "High"])
def test_a_pose_that_became_the_rest_is_noticed(is_posed_anew, bone):
    """Low takes all vertices along, High leaves a quarter where they were."""
    ball, rig = ball_with_bones()
    cubify()
    assert not is_posed_anew(ball)
    apply_pose(ball, rig, bone)
    assert is_posed_anew(ball)
    assert WORDS not in reports_of(lambda: cubify(start="HERE"))
    assert not is_posed_anew(ball)


def test_cubify_offers_from_here_and_changes_nothing_else(is_posed_anew):
    ball, rig = ball_with_bones()
    cubify()
    apply_pose(ball, rig)
    printed = reports_of(lambda: cubify())
    assert WORDS in printed and "Cubified" in printed
    assert WORDS not in reports_of(lambda: cubify())


@pytest.mark.parametrize("has_rig", [False, True])
def test_nearly_all_that_moved_is_noticed_and_strokes_are_not(is_posed_anew, has_rig):
    ball, _ = ball_with_bones()
    if not has_rig:
        ball.modifiers.clear()
    cubify()
    for vertex in ball.data.vertices[:200]:
        vertex.co.z += 0.1
    ball.data.update()
    assert not is_posed_anew(ball)
    for vertex in ball.data.vertices:
        vertex.co.z += 0.2 * vertex.co.x**2 + 0.05
    ball.data.update()
    assert is_posed_anew(ball)


def test_what_moved_as_a_whole_is_not(is_posed_anew):
    """Also with bones and a stroke: those of the run are taken along."""
    ball, rig = ball_with_bones()
    rig.parent = ball
    cubify()
    ball.scale, ball.location.x = (2.0, 2.0, 2.0), 1.0
    bpy.ops.object.transform_apply(scale=True, location=True)
    bpy.context.view_layer.update()
    assert not is_posed_anew(ball)
    for vertex in ball.data.vertices[:20]:
        vertex.co.z += 0.1
    ball.data.update()
    assert not is_posed_anew(ball)
