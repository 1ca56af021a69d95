# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles that are moved while Live runs: what follows, what is taken back, and what is kept."""

import bpy
import numpy as np
import pytest
from live_steps import bits, check_gone, confirm, tick_to_rest
from mathutils import Matrix
from posing import IDENTITY, LEFT, RIGHT, add_posable, mapped, pin
from rich_mesh import position_of
from scene import select

UP, FAR_UP = (
    tuple(np.array(Matrix.Translation((0, 0, z)), dtype=np.float32).astype(float).ravel())
    for z in (0.5, 1.25)
)


def add_pinned():
    """Pin both ends of a shape as a step that can be undone; return it and the right end."""
    obj, _, right = add_posable()
    pin(obj, LEFT)
    pin(obj, RIGHT)
    bpy.ops.ed.undo_push(message="Handles")
    return obj, right


def handle_of(obj):
    return obj.cubic_craft.handles[1]


def check_right(obj, right, original, pose):
    assert position_of(obj.data)[right].tobytes() == mapped(original[right], pose).tobytes()


def test_confirming_keeps_the_pose_and_leaves_the_bits_of_cubify(live, begin):
    obj, right = add_pinned()
    original = position_of(obj.data)
    session = tick_to_rest(begin(obj))
    live.set_pose(obj, handle_of(obj), UP)
    assert session._timer is not None, "the pose has not woken it"
    assert handle_of(obj).pose == Matrix(), "until Live is confirmed the object keeps its own"
    tick_to_rest(session)
    check_right(obj, right, original, UP)
    confirm(live, session)
    check_gone(live)
    assert live.pose_of(obj, handle_of(obj)) == UP
    assert handle_of(obj).pose == Matrix.Translation((0, 0, 0.5))
    shape = bits(obj)
    select(obj)
    bpy.ops.cubic_craft.restore()
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == shape
    assert bpy.ops.cubic_craft.apply() == {"FINISHED"}
    assert handle_of(obj).pose == Matrix()


@pytest.mark.parametrize("before", [IDENTITY, FAR_UP])
def test_cancelling_leaves_the_pose_from_before(live, begin, before):
    obj, _ = add_pinned()
    handle_of(obj).pose = Matrix(np.reshape(before, (4, 4)).tolist())
    original = bits(obj)
    session = raised(live, begin(obj), obj)
    session.on(live.Event.CANCEL)
    check_gone(live)
    assert live.pose_of(obj, handle_of(obj)) == before
    assert bits(obj) == original


def raised(live, session, obj):
    """Let it come to rest before and after the handle is moved up; returns the session."""
    tick_to_rest(session)
    live.set_pose(obj, handle_of(obj), UP)
    return tick_to_rest(session)


def drag(live, session, obj, *poses):
    """Drag the handle as the gizmo does."""
    is_on = [True]
    session.begin_drag(lambda: is_on[0])
    assert session.is_dragged()
    for pose in poses:
        live.set_pose(obj, handle_of(obj), pose)
        tick_to_rest(session)
    is_on[0] = False


def test_every_drag_is_one_change_to_take_back(live, begin, monkeypatch):
    monkeypatch.setattr(f"{live.__name__}.history.PAUSE", 0.0)  # as if it took long
    obj, right = add_pinned()
    original = position_of(obj.data)
    session = tick_to_rest(begin(obj))
    at_rest = bits(obj)
    drag(live, session, obj, UP, FAR_UP)
    monkeypatch.setattr(f"{live.__name__}.history.PAUSE", 1e9)  # as if the next came at once
    drag(live, session, obj, IDENTITY, UP)
    check_right(obj, right, original, UP)
    assert session.take_back()
    tick_to_rest(session)
    check_right(obj, right, original, FAR_UP)
    assert session.take_back()
    tick_to_rest(session)
    assert bits(obj) == at_rest
    drag(live, session, obj, UP, IDENTITY)  # as Esc in a drag leaves it
    assert session.take_back() and session.is_ended, "nothing was left to take back"


def test_reset_pose_is_a_change_to_take_back(live, begin):
    obj, right = add_pinned()
    original = position_of(obj.data)
    handle_of(obj).pose = Matrix.Translation((0, 0, 0.5))
    session = tick_to_rest(begin(obj))
    check_right(obj, right, original, UP)
    assert bpy.ops.cubic_craft.handle_reset_pose("EXEC_DEFAULT", True) == {"CANCELLED"}
    tick_to_rest(session)
    check_right(obj, right, original, IDENTITY)
    assert not bpy.ops.cubic_craft.handle_reset_pose.poll()
    assert session.take_back()
    tick_to_rest(session)
    check_right(obj, right, original, UP)
    assert bpy.ops.cubic_craft.handle_reset_pose.poll()


def test_blenders_undo_steps_leave_the_poses_of_live(live, begin):
    obj, right = add_pinned()
    original, name = position_of(obj.data), obj.name
    session = raised(live, begin(obj), obj)
    obj.cubic_craft.active_handle = 0
    assert bpy.ops.cubic_craft.handle_remove("EXEC_DEFAULT", True) == {"FINISHED"}
    tick_to_rest(session)
    check_right(obj, right, original, UP)
    assert not session.take_back(), "Ctrl-Z is for Blender, which has removed the other handle"
    bpy.ops.ed.undo()
    tick_to_rest(session)
    obj = bpy.data.objects[name]
    assert handle_of(obj).group == RIGHT
    check_right(obj, right, original, UP)
    confirm(live, session)
    assert live.pose_of(obj, handle_of(obj)) == UP


def test_a_file_saved_in_the_middle_has_the_pose(live, begin, tmp_path):
    obj, right = add_pinned()
    original = position_of(obj.data)
    session = raised(live, begin(obj), obj)
    path = str(tmp_path / "middle.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    tick_to_rest(session)
    check_right(obj, right, original, UP)
    session.on(live.Event.CANCEL)
    assert handle_of(obj).pose == Matrix() and bits(obj) == original.tobytes()
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.data.objects["Body"]
    assert handle_of(obj).pose != Matrix()
    check_right(obj, right, original, UP)
