# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen of a crisp shape while a setting is dragged, and what it comes to."""

import bpy
import numpy as np
import pytest
from flat_balls import add_ball
from live_steps import bits, check_same_as_cubify, confirm, follower_of, tick_to_rest
from mathutils import Euler, Matrix
from posing import pin
from rich_mesh import position_of

FLAT = np.cos(np.radians(6.0))
STILL = 0.1  # of the size: a shape that begins again from the original jumps farther


def share_flat(obj, orientation=(0.0, 0.0, 0.0)):
    """Return the share of the area that faces along an axis of the cube."""
    areas = np.array([polygon.area for polygon in obj.data.polygons])
    normals = np.array([polygon.normal for polygon in obj.data.polygons])
    local = normals @ np.array(Euler(orientation).to_matrix())
    return areas[np.abs(local).max(axis=1) > FLAT].sum() / areas.sum()


def drag(live, session, obj, values, ticks=3, name="cubeness"):
    """Drag a setting; return the flat share of what was seen, and the largest step of it."""
    shares, steps, before = [], [], position_of(obj.data)
    for value in values:
        setattr(live.live_properties(), name, value)
        for _ in range(ticks):
            session.tick(bpy.context)
            bpy.context.view_layer.update()
            now = position_of(obj.data)
            shares.append(share_flat(obj, live.live_properties().orientation))
            steps.append(np.linalg.norm(now - before, axis=1).max())
            before = now
    return min(shares), max(steps) / np.ptp(before, axis=0).max()


@pytest.mark.thorough(1)
@pytest.mark.parametrize("crispness", [1.0, 0.5])
def test_a_crisp_shape_stays_crisp_while_cubeness_is_dragged(live, begin, one_phase, crispness):
    obj = add_ball()
    session = tick_to_rest(begin(obj, cubeness=0.4, crispness=crispness))
    at_rest = share_flat(obj)
    shape = bits(obj)
    least, farthest = drag(live, session, obj, np.linspace(0.4, 0.5, 5)[1:], ticks=40)
    assert bits(obj) != shape, "nothing was seen"
    assert least > 0.9 * at_rest
    assert farthest < STILL
    confirm(live, session)
    check_same_as_cubify(obj)


DRAGGED = {
    "orientation": [(0.0, 0.0, angle) for angle in np.arange(0.05, 0.75, 0.05)],
    "detail": [0.06, 0.08],
    "detail_strength": [1.1, 1.5],
    "solidity": [0.4, 0.5],
    "form_weights": [(1.0, 1.0, weight) for weight in (0.95, 0.9, 0.8)],
}


@pytest.fixture
def no_time(live, monkeypatch):
    """Let shapes follow at once: a fast machine drags farther than they take in their time."""
    monkeypatch.setattr(f"{live.__name__}.ease.SECONDS", 1e-6)
    monkeypatch.setattr(f"{live.__name__}.session._LEAST_LIFE", 0.0)


@pytest.mark.thorough(3)
@pytest.mark.parametrize("name", DRAGGED)
def test_a_crisp_shape_stays_crisp_while_other_settings_are_dragged(
    live, begin, one_phase, no_time, name
):
    obj = add_ball()
    form = "BOX" if name == "form_weights" else "CUBE"
    session = tick_to_rest(begin(obj, cubeness=0.4, crispness=1.0, form=form))
    shape = bits(obj)
    least, farthest = drag(live, session, obj, DRAGGED[name], ticks=30, name=name)
    assert bits(obj) != shape, "nothing was seen"
    tick_to_rest(session)
    end = share_flat(obj, live.live_properties().orientation)
    assert least > 0.85 * end
    assert farthest < STILL
    confirm(live, session)
    check_same_as_cubify(obj)


@pytest.mark.thorough(1)
@pytest.mark.parametrize("is_cubic", [False, True])
def test_a_crisp_shape_stays_crisp_while_a_handle_is_dragged(live, begin, one_phase, is_cubic):
    obj = add_ball()
    heights = position_of(obj.data)[:, 2]
    for name, vertices in (("Low", heights < -0.9), ("High", heights > 0.9)):
        group = obj.vertex_groups.new(name=name)
        group.add(np.flatnonzero(vertices).tolist(), 1.0, "REPLACE")
        pin(obj, name).is_cubic = is_cubic
    session = tick_to_rest(begin(obj, cubeness=0.4, crispness=1.0))
    shape, seen = bits(obj), []
    for height in np.arange(0.05, 0.4, 0.05):
        pose = np.array(Matrix.Translation((0.0, 0.0, height)), np.float32).astype(float)
        live.set_pose(obj, obj.cubic_craft.handles[1], tuple(pose.ravel()))
        for _ in range(30):
            session.tick(bpy.context)
            bpy.context.view_layer.update()
            seen.append(share_flat(obj))
    assert bits(obj) != shape, "nothing was seen"
    tick_to_rest(session)
    assert min(seen) > 0.85 * share_flat(obj)
    confirm(live, session)
    check_same_as_cubify(obj)


def test_a_crisp_follower_stays_crisp_while_the_original_is_worked_on(
    live, follow, one_phase, monkeypatch
):
    obj = add_ball()
    session = tick_to_rest(follow(obj, cubeness=0.4, crispness=1.0))
    run, follower, seen = session.meshes[0].run, follower_of(obj), []

    def tick_while(condition):
        while condition():
            session.tick(bpy.context)
            bpy.context.view_layer.update()
            seen.append(share_flat(follower))

    for _ in range(3):
        monkeypatch.setattr(f"{live.__name__}.pace.LEAST_PAUSE", 1e6)
        points = position_of(obj.data)
        points[:, 2] *= np.where(points[:, 2] > 0.0, 1.05, 1.0)
        obj.data.vertices.foreach_set("co", points.ravel())
        obj.data.update()
        obj.update_tag(refresh={"DATA"})
        bpy.context.view_layer.update()
        before = run._run
        tick_while(lambda before=before: run._run is before or run.is_working)
        monkeypatch.setattr(f"{live.__name__}.pace.LEAST_PAUSE", 0.0)
        tick_while(lambda: not run._is_behind or run.iterations < 4)  # the next one interrupts it
    assert min(seen) > 0.8


def test_a_crisp_shape_stays_crisp_while_its_map_is_painted(live, begin, one_phase):
    obj = add_ball()
    group = obj.vertex_groups.new(name="Map")
    everywhere = range(len(obj.data.vertices))
    group.add(everywhere, 0.8, "REPLACE")
    session = tick_to_rest(begin(obj, cubeness=0.5, crispness=1.0, map_group="Map"))
    at_rest, shape, seen = share_flat(obj), bits(obj), []
    for weight in (0.85, 0.9, 0.95):
        group.add([v for v in everywhere if obj.data.vertices[v].co.z > 0.0], weight, "REPLACE")
        session.on_mesh_update()
        for _ in range(30):
            session.tick(bpy.context)
            bpy.context.view_layer.update()
            seen.append(share_flat(obj))
        assert session.meshes[0].run._is_restyled
    assert bits(obj) != shape, "nothing was seen"
    assert min(seen) > 0.9 * at_rest
    confirm(live, session)
    check_same_as_cubify(obj)


def test_the_shape_of_cubify_is_reached_in_small_steps(live, begin, part, one_phase, monkeypatch):
    obj = add_ball()
    session = tick_to_rest(begin(obj, cubeness=0.2, crispness=1.0))
    drag(live, session, obj, [0.5], ticks=40)
    ease, mesh, seen, path = part("live.ease"), session.meshes[0], None, []
    monkeypatch.setattr(ease, "SECONDS", 1e6)  # however slow the machine is
    while mesh.solution is None:
        seen = position_of(obj.data)
        session.tick(bpy.context)
    end = mesh.solution.positions
    gap = np.abs(seen - end).max()
    assert gap > 1e-3
    for _ in range(3):
        session.tick(bpy.context)
        assert session._timer is not None, "it rests on the way"
        path.append(np.abs(position_of(obj.data) - end).max())
    assert min(path) > 0.99 * gap
    monkeypatch.setattr(ease, "SECONDS", 1e-6)
    tick_to_rest(session)
    shape = bits(obj)
    confirm(live, session)
    assert bits(obj) == shape
    check_same_as_cubify(obj)


@pytest.mark.thorough(2)
@pytest.mark.parametrize("ending", ["CONFIRM", "CANCEL", "SAVE", "UNDONE"])
def test_on_the_way_to_the_shape_of_cubify(live, begin, part, one_phase, monkeypatch, ending):
    """Whatever ends or interrupts it there, nothing of the way is left."""
    obj = add_ball()
    before = bits(obj)
    monkeypatch.setattr(part("live.ease"), "SECONDS", 1e6)
    session = tick_to_rest(begin(obj, cubeness=0.2, crispness=1.0))
    drag(live, session, obj, [0.5], ticks=40)
    while session.meshes[0].solution is None or not session.meshes[0]._ease.is_on:
        session.tick(bpy.context)
    if ending == "CANCEL":
        session.on(live.Event.CANCEL)
        assert session.is_ended and bits(obj) == before
        return
    if ending == "SAVE":
        session.on(live.Event.SAVE)
        saved = bits(obj)
        session.on(live.Event.SAVED)
    if ending == "UNDONE":
        session.on_undo()
    confirm(live, session)
    assert ending != "SAVE" or bits(obj) == saved
    check_same_as_cubify(obj)


def test_a_soft_shape_begins_again_from_the_original(live, begin, one_phase):
    obj = add_ball()
    session = tick_to_rest(begin(obj, cubeness=0.4, crispness=0.0))
    run = session.meshes[0].run
    live.live_properties().cubeness = 0.5
    session.tick(bpy.context)
    assert not run._is_restyled and session.meshes[0].run.iterations <= 1
    confirm(live, session)
    check_same_as_cubify(obj)
