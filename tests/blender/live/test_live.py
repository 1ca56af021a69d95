# SPDX-License-Identifier: GPL-3.0-or-later
"""Live without its window: the session is driven tick by tick, and what happens to it is real."""

import importlib

import bpy
import pytest
from live_steps import (
    add_monkey,
    bits,
    check_gone,
    confirm,
    follower_of,
    tick_to_rest,
    tick_to_sight,
)
from rich_mesh import add_rich_monkey
from scene import QUICK, add_triangles, change_settings, cubify, select
from snapshot import differences, snapshot_mesh, snapshot_object


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_confirming_leaves_the_bits_of_cubify(live, begin, result):
    twin, obj = add_monkey("Twin"), add_monkey()
    settings = {"refine": "AUTO", "keep_apart": True} if result == "MESH" else QUICK
    change_settings(twin, **settings)
    session = tick_to_rest(begin(obj, result=result, cubeness=0.7, **settings))
    confirm(live, session)
    check_gone(live)
    assert bpy.context.object == obj
    one = snapshot_mesh((follower_of(obj) if result == "NEW_OBJECT" else obj).data)
    select(twin)
    twin.cubic_craft.result, twin.cubic_craft.cubeness = result, 0.7
    bpy.ops.cubic_craft.cubify()
    other = snapshot_mesh(bpy.context.object.data)
    assert not differences(one, other, ignore=("*name*", "rna/shape_keys", "shape_keys/rna/user"))
    assert bits(obj) == bits(twin)


def test_a_change_that_had_to_wait_is_not_forgotten(live, begin, one_phase):
    """Runs are left alone until they are seen; confirming at once must not write such a run."""
    twin, obj = add_monkey("Twin"), add_monkey()
    change_settings(twin, keep_apart=True)
    session = tick_to_rest(begin(obj, cubeness=0.2, keep_apart=True))
    live.live_properties().cubeness = 0.6
    session.tick(bpy.context)
    session._last_restart = float("inf")  # the run stays young until it has ended
    live.live_properties().cubeness = 0.7
    confirm(live, session)
    select(twin)
    bpy.ops.cubic_craft.cubify(cubeness=obj.cubic_craft.cubeness)
    assert obj.cubic_craft.cubeness == pytest.approx(0.7)
    assert bits(obj) == bits(twin)


def test_a_change_restarts_within_one_tick(live, begin, one_phase):
    obj = add_triangles()
    session = tick_to_rest(begin(obj))
    assert session.meshes[0].run.iterations > 10
    live.live_properties().cubeness = 0.8
    assert session._timer is not None, "the change has not woken it"
    before = bits(obj)
    session.tick(bpy.context)
    assert session.meshes[0].run.is_working and session.meshes[0].run.iterations <= 1
    assert session._is_too_young(float("inf")), "another change waits until it is seen"
    tick_to_sight(session)
    assert bits(obj) != before
    assert session._is_too_young(session._last_restart), "and for a moment"
    tick_to_rest(session)


@pytest.mark.parametrize("cubified", [False, True])
def test_cancelling_leaves_all_as_before(live, begin, cubified):
    obj = add_rich_monkey(keys=True)
    select(obj)
    if cubified:
        assert cubify(cubeness=0.3) == {"FINISHED"}
    before = snapshot_mesh(obj.data), snapshot_object(obj)
    settings = obj.cubic_craft.cubeness
    session = begin(obj)
    live.live_properties().cubeness = 0.9
    for _ in range(10):
        session.tick(bpy.context)
    session.on(live.Event.CANCEL)
    check_gone(live)
    after = snapshot_mesh(obj.data), snapshot_object(obj)
    # Blender 4.2 makes the group of our settings when it is first looked at.
    ignore = ("custom/custom cubic_craft",)
    assert not [
        differences(*pair, ignore)
        for pair in zip(before, after, strict=True)
        if differences(*pair, ignore)
    ]
    assert obj.cubic_craft.cubeness == settings


def test_idle_does_nothing_until_something_happens(live, begin):
    obj = add_monkey()
    session = tick_to_rest(begin(obj))
    assert session._timer is None
    bpy.context.view_layer.update()  # the last change of Live itself does not wake it
    assert session._timer is None
    obj.location.x += 1.0
    bpy.context.view_layer.update()
    assert session._timer is not None
    run = session.meshes[0].run
    before = run.iterations
    session.tick(bpy.context)
    assert session._timer is None and run.iterations == before, "moved is not turned"


def test_a_large_mesh_is_seen_to_move_on_coarser_ones_first(
    live, begin, one_phase, extension, monkeypatch
):
    coarse_start = importlib.import_module(f"{extension.__name__}.solver.coarse_to_fine.start")
    monkeypatch.setattr(coarse_start, "LEAST_VERTICES", 300)
    monkeypatch.setattr(coarse_start, "COARSEST_VERTICES", 100)
    twin, obj = add_monkey("Twin"), add_monkey()
    before = bits(obj)
    session = begin(obj, cubeness=0.6)
    mesh = session.meshes[0]
    assert mesh.run._run.is_on_coarser_mesh
    while mesh.run._run.iterations < 6:
        session.tick(bpy.context)
    assert mesh.run._run.is_on_coarser_mesh and mesh.run.iterations == 0
    assert bits(obj) != before and mesh.run.status[0][0] == "First on a coarser mesh"
    confirm(live, session)
    select(twin)
    bpy.ops.cubic_craft.cubify(cubeness=0.6)
    assert bits(obj) == bits(twin)


@pytest.mark.parametrize("together", ["PARTS", "SELECTION"])
def test_several_objects_are_live_together(live, begin, together):
    places = [(0, 0, 0), (2, 0.5, 0)]
    twins = [add_monkey(f"Twin {place}", location=place) for place in places]
    objects = [add_monkey(f"Object {place}", location=place) for place in places]
    objects[1].cubic_craft.cubeness = 0.05  # the active one counts
    session = begin(*objects, cubeness=0.6, together=together)
    before = [bits(obj) for obj in objects]
    tick_to_sight(session)
    assert all(bits(obj) != b for obj, b in zip(objects, before, strict=True))
    confirm(live, session)
    select(*twins)
    bpy.ops.cubic_craft.cubify(cubeness=0.6, together=together)
    assert [bits(obj) for obj in objects] == [bits(obj) for obj in twins]


def test_the_panel_stays_that_of_live_whatever_is_active(live, begin):
    a, b = add_monkey("A"), add_monkey("B")
    session = begin(a, b)
    bpy.context.view_layer.objects.active = None
    assert session.first_object(bpy.context) == a
    bpy.data.objects.remove(a)
    assert session.first_object(bpy.context) == b


def test_the_other_operators_wait(live, begin):
    session = begin(add_monkey())
    for name in ("cubify", "restore", "apply"):
        assert not getattr(bpy.ops.cubic_craft, name).poll()
    session.on(live.Event.CANCEL)
    assert bpy.ops.cubic_craft.cubify.poll()


def test_an_object_that_cannot_be_used_is_refused_and_nothing_starts(live, begin, extension):
    solver = importlib.import_module(f"{extension.__name__}.solver")
    obj = add_monkey()
    obj.data.vertices[3].co.x = float("nan")
    with pytest.raises(solver.CubicCraftError, match="not finite"):
        begin(obj)
    assert live.current() is None
    assert not [a.name for a in obj.data.attributes if a.name.startswith("cubic_craft")]


def test_without_a_window_it_says_so():
    add_monkey()
    with pytest.raises(RuntimeError, match="needs a window"):
        bpy.ops.cubic_craft.live()
