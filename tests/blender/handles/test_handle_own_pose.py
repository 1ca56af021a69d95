# SPDX-License-Identifier: GPL-3.0-or-later
"""The pose that a handle has of itself: where it counts, and what becomes of it."""

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from posing import IDENTITY, LEFT, RIGHT, add_posable, follow, mapped, pin
from rich_mesh import position_of
from scene import cubify, given, select

BENT = Matrix.LocRotScale((0.4, -0.2, 0.5), Matrix.Rotation(0.6, 3, "Y"), (1.2, 0.8, 1.5))


def numbers(matrix):
    """Return a matrix as 16 numbers of single precision, row by row."""
    return tuple(np.array(matrix, dtype=np.float32).astype(float).ravel())


def add_bent(**where):
    """Pin both ends, and give the right one a pose."""
    obj, left, right = add_posable(**where)
    pin(obj, LEFT)
    pin(obj, RIGHT).pose = BENT
    return obj, left, right


def test_it_moves_the_vertices_as_a_given_handle_does(posed):
    obj, left, right = add_bent(location=(5, -3, 2), rotation_euler=(0.4, 1.2, -2.0))
    before = position_of(obj.data)
    assert [handle.matrix for handle in posed(obj)] == [IDENTITY, numbers(BENT)]
    cubify()
    after = position_of(obj.data)
    assert after[left].tobytes() == before[left].tobytes()
    assert after[right].tobytes() == mapped(before[right], numbers(BENT)).tobytes()
    cubify(handles=[given(LEFT), given(RIGHT, BENT)])
    assert position_of(obj.data).tobytes() == after.tobytes()


def test_what_is_followed_moves_it_on_from_there(posed):
    obj, _, right = add_bent()
    before = position_of(obj.data)
    cubify()
    once = position_of(obj.data)
    obj.cubic_craft.active_handle = 1
    assert bpy.ops.cubic_craft.handle_follow() == {"FINISHED"}
    empty = bpy.context.object
    select(obj)
    cubify()
    assert position_of(obj.data).tobytes() == once.tobytes(), "to follow something moves nothing"
    middle = (once[right].min(axis=0) + once[right].max(axis=0)) / 2
    np.testing.assert_allclose(empty.location, middle, atol=1e-6)
    empty.location.z += 1
    cubify()
    wanted = mapped(before[right], numbers(BENT)) + np.array([0, 0, 1], np.float32)
    np.testing.assert_allclose(position_of(obj.data)[right], wanted, atol=1e-5)
    assert bpy.ops.cubic_craft.handle_reset_pose() == {"FINISHED"}
    assert [handle.matrix for handle in posed(obj)] == [IDENTITY] * 2


def test_reset_pose_takes_it_away_in_one_undo_step():
    obj, _, _ = add_bent()
    bpy.ops.ed.undo_push(message="Pose")
    bpy.ops.cubic_craft.handle_reset_pose("EXEC_DEFAULT", True)
    assert obj.cubic_craft.handles[1].pose == Matrix()
    bpy.ops.ed.undo()
    assert bpy.data.objects["Body"].cubic_craft.handles[1].pose == BENT
    bpy.ops.ed.redo()
    assert bpy.data.objects["Body"].cubic_craft.handles[1].pose == Matrix()
    select(bpy.data.objects["Body"])
    assert not bpy.ops.cubic_craft.handle_reset_pose.poll()


@pytest.mark.parametrize("then", [None, Matrix(), Matrix.Translation((0, 0, 2)) @ BENT])
def test_apply_makes_it_the_rest(posed, then):
    obj, _, _ = add_bent()
    cubify()
    if then is not None:
        obj.cubic_craft.handles[1].pose = then
    assert bpy.ops.cubic_craft.apply() == {"FINISHED"}
    wanted = Matrix() if then is None else then @ BENT.inverted()
    np.testing.assert_allclose(posed(obj)[1].matrix, numbers(wanted), atol=1e-6)
    assert (posed(obj)[1].matrix == IDENTITY) == (then is None)
    assert obj.cubic_craft.handles[1].pose != BENT


def test_apply_keeps_pose_and_motion_of_a_handle_that_follows(posed):
    obj, _, _ = add_posable()
    pin(obj, LEFT)
    empty = follow(obj, RIGHT)
    obj.cubic_craft.handles[1].pose = BENT
    empty.location.x += 0.3
    select(obj)
    cubify()
    assert bpy.ops.cubic_craft.apply() == {"FINISHED"}
    assert posed(obj)[1].matrix == IDENTITY
    empty.location.x += 0.5
    wanted = numbers(Matrix.Translation((0.5, 0, 0)))
    np.testing.assert_allclose(posed(obj)[1].matrix, wanted, atol=1e-6)


@pytest.mark.parametrize(
    "pose",
    [
        Matrix.Diagonal((1, 0, 1, 1)),
        Matrix.Translation((float("nan"), 0, 0)),
        Matrix.Translation((1, 2, 3)).transposed(),
    ],
)
def test_a_pose_that_cannot_be_used_is_refused_and_can_be_reset(pose):
    obj, _, _ = add_bent()
    before = position_of(obj.data)
    obj.cubic_craft.handles[1].pose = pose
    select(obj)
    with pytest.raises(RuntimeError, match=f'"{RIGHT}" of "Body".*; click Reset Pose'):
        cubify()
    assert position_of(obj.data).tobytes() == before.tobytes()
    assert bpy.ops.cubic_craft.handle_reset_pose() == {"FINISHED"}
    assert cubify() == {"FINISHED"}
