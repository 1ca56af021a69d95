# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen of a crisp shape while a setting is dragged, and what it comes to."""

import bpy
import numpy as np
import pytest
from flat_balls import add_ball
from live_steps import bits, check_same_as_cubify, confirm, tick_to_rest
from rich_mesh import position_of

FLAT = np.cos(np.radians(6.0))
STILL = 0.1  # of the size: a shape that begins again from the original jumps farther


def share_flat(obj):
    """Return the share of the area that faces along an axis of the cube."""
    areas = np.array([polygon.area for polygon in obj.data.polygons])
    normals = np.array([polygon.normal for polygon in obj.data.polygons])
    return areas[np.abs(normals).max(axis=1) > FLAT].sum() / areas.sum()


def drag(live, session, obj, values, ticks=3):
    """Drag the cubeness; return the flat share of what was seen, and the largest step of it."""
    shares, steps, before = [], [], position_of(obj.data)
    for value in values:
        live.live_properties().cubeness = value
        for _ in range(ticks):
            session.tick(bpy.context)
            bpy.context.view_layer.update()
            now = position_of(obj.data)
            shares.append(share_flat(obj))
            steps.append(np.linalg.norm(now - before, axis=1).max())
            before = now
    return min(shares), max(steps) / np.ptp(before, axis=0).max()


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
    assert not run._is_restyled and session.meshes[0].iterations <= 1
    confirm(live, session)
    check_same_as_cubify(obj)
