# SPDX-License-Identifier: GPL-3.0-or-later
"""What Live looks at: the frame, weights, handles and settings that change under it."""

import importlib

import bpy
import numpy as np
import pytest
from live_steps import add_monkey, bits, check_same_as_cubify, confirm, tick_to_rest
from posing import LEFT, RIGHT, add_posable, follow, pin, pose
from rich_mesh import position_of
from scene import add_empty, add_triangles


def test_the_frame_object_restarts_it(live, begin):
    obj = add_triangles()
    frame = add_empty("Frame")
    session = begin(obj, space="FRAME", frame=frame)
    assert live.live_properties().frame == "Frame"
    tick_to_rest(session)
    before = bits(obj)
    frame.rotation_euler = (0.3, 0.2, 0.5)
    tick_to_rest(session)
    assert bits(obj) != before
    confirm(live, session)
    check_same_as_cubify(obj)


def test_the_frame_object_may_be_deleted(live, begin):
    obj = add_monkey()
    frame = add_empty("Frame")
    session = tick_to_rest(begin(obj, space="FRAME", frame=frame))
    bpy.data.objects.remove(frame)
    live.live_properties().cubeness = 0.5
    tick_to_rest(session)
    assert "Frame" in session.all_problems[0]
    live.live_properties().space = "WORLD"
    confirm(live, session)
    assert session.written.summary


def test_painted_weights_restart_it(live, begin):
    obj = add_triangles()
    group = obj.vertex_groups.new(name="Map")
    group.add(range(len(obj.data.vertices)), 1.0, "REPLACE")
    session = tick_to_rest(begin(obj, map_group="Map", cubeness=0.8))
    before = bits(obj)
    bpy.context.view_layer.update()
    group.add(range(len(obj.data.vertices) // 2), 0.0, "REPLACE")
    obj.data.update()
    bpy.context.view_layer.update()
    assert session._timer is not None
    tick_to_rest(session)
    assert bits(obj) != before
    confirm(live, session)
    check_same_as_cubify(obj)


def test_a_handle_is_posed_live(live, begin):
    obj, _, right = add_posable()
    pin(obj, LEFT)
    empty = follow(obj, RIGHT)
    session = tick_to_rest(begin(obj, cubeness=0.0))
    before = position_of(obj.data)
    empty.location.x += 0.7
    bpy.context.view_layer.update()
    assert session._timer is not None, "the moved empty has not woken it"
    tick_to_rest(session)
    moved = position_of(obj.data) - before
    np.testing.assert_allclose(moved[right], [[0.7, 0.0, 0.0]] * len(right), atol=1e-5)
    assert not session.take_back(), "Ctrl-Z is for Blender, which has moved the empty"
    confirm(live, session)
    check_same_as_cubify(obj)


def test_moving_object_and_handles_together_restarts_nothing(live, begin):
    obj, _, _ = add_posable()
    empty = pose(obj)
    session = begin(obj, space="OBJECT")  # which takes the cube along
    tick_to_rest(session)
    done = session.meshes[0].run.iterations
    obj.location = (0.3, 5.1, -2.7)
    obj.rotation_euler = (0.4, 1.0, 0.2)
    bpy.context.view_layer.update()
    session.tick(bpy.context)
    assert session.meshes[0].run.iterations == done and session._timer is None
    assert empty.parent == obj


def test_a_setting_that_cannot_be_used_waits_for_a_better_one(live, begin):
    obj = add_monkey()
    session = tick_to_rest(begin(obj))
    live.live_properties().map_group = "Missing"
    tick_to_rest(session)
    assert "Missing" in session.all_problems[0]
    session.on(live.Event.CONFIRM)
    tick_to_rest(session)
    assert not session.is_ended, "there is nothing to confirm"
    live.live_properties().map_group = ""
    tick_to_rest(session)
    assert not session.all_problems
    confirm(live, session)
    assert session.written.summary


def test_auto_orient_turns_the_live_cube(live, begin):
    obj = add_triangles()
    session = begin(obj)
    session.tick(bpy.context)
    bpy.ops.cubic_craft.auto_orient()
    found = tuple(live.live_properties().orientation)
    assert any(found) and not any(obj.cubic_craft.orientation)
    session.on(live.Event.CANCEL)
    bpy.ops.cubic_craft.auto_orient()
    assert tuple(obj.cubic_craft.orientation) == pytest.approx(found, abs=1e-6)


def test_crispness_is_followed_without_another_run(live, begin, extension, monkeypatch):
    solver = importlib.import_module(f"{extension.__name__}.solver").Stylization
    step, steps = solver.global_step, []
    monkeypatch.setattr(solver, "global_step", lambda *given: (steps.append(1), step(*given))[1])
    obj = add_monkey()
    session = tick_to_rest(begin(obj, crispness=0.2, refine="AUTO"))
    before, of_run = bits(obj), len(steps)
    live.live_properties().crispness = 0.9
    tick_to_rest(session)
    assert bits(obj) != before
    assert len(steps) == of_run
    confirm(live, session)
    assert obj.cubic_craft.crispness == pytest.approx(0.9)
    check_same_as_cubify(obj)
