# SPDX-License-Identifier: GPL-3.0-or-later
"""Live without its window: the session is driven tick by tick, and what happens to it is real."""

import importlib
import time

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from posing import LEFT, RIGHT, add_posable, follow, pin, pose
from rich_mesh import add_rich_monkey, position_of
from scene import add_monkey, add_triangles, cubify, select
from snapshot import differences, snapshot_mesh, snapshot_object

STEPS = 400


@pytest.fixture
def live(extension):
    module = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.live")
    yield module
    session = module.current()
    if session is not None:
        session.on(module.Event.CANCEL)


@pytest.fixture
def begin(live):
    def start(*objects, **settings):
        for name, value in settings.items():
            setattr(objects[0].cubic_craft, name, value)
        select(*objects)
        return live.begin(bpy.context, list(objects))

    return start


def bits(obj):
    values = np.empty(3 * len(obj.data.vertices), np.float32)
    obj.data.vertices.foreach_get("co", values)
    return values.tobytes()


def tick_to_rest(session):
    for _ in range(STEPS):
        session.tick(bpy.context)
        bpy.context.view_layer.update()
        if session.is_ended or session._timer is None:
            return
    raise AssertionError("Live does not come to rest")


def confirm(live, session):
    session.on(live.Event.CONFIRM)
    tick_to_rest(session)
    assert session.is_ended and not session.error and not session.problems
    return session


def check_gone(live):
    assert live.current() is None
    handlers = importlib.import_module(f"{live.__name__}.handlers")
    wake = importlib.import_module(f"{live.__name__}.wake")
    assert not handlers.is_installed() and wake._listener is None
    for name, handler in handlers._HANDLERS:
        assert handler not in getattr(bpy.app.handlers, name)
    session = live._session
    assert session._timer is None
    assert not session.tasks and session._choice.frame is None
    for mesh in session.meshes:
        assert mesh._preview is None and mesh._prepared is None and mesh._run is None
    for mesh in bpy.data.meshes:
        assert not [a.name for a in mesh.attributes if a.name.startswith("cubic_craft_live")]


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_confirming_leaves_the_bits_of_cubify(live, begin, result):
    twin = add_monkey("Twin")
    obj = add_monkey()
    session = begin(obj, result=result, cubeness=0.7)
    tick_to_rest(session)
    confirm(live, session)
    check_gone(live)
    one = snapshot_mesh(bpy.context.object.data)
    select(twin)
    twin.cubic_craft.result, twin.cubic_craft.cubeness = result, 0.7
    bpy.ops.cubic_craft.cubify()
    other = snapshot_mesh(bpy.context.object.data)
    assert not differences(one, other, ignore=("*name*", "rna/shape_keys", "shape_keys/rna/user"))
    assert bits(obj) == bits(twin)


def test_the_path_does_not_matter(live, begin):
    twin, obj = add_monkey("Twin"), add_monkey()
    session = begin(obj, cubeness=0.1)
    for cubeness in (0.9, 0.3, 2.0, 0.55):
        live.live_properties().cubeness = cubeness
        for _ in range(2):
            session.tick(bpy.context)
    live.live_properties().orientation = (0.1, 0.2, 0.3)
    confirm(live, session)
    assert obj.cubic_craft.cubeness == pytest.approx(0.55)
    select(twin)
    bpy.ops.cubic_craft.cubify(cubeness=obj.cubic_craft.cubeness, orientation=(0.1, 0.2, 0.3))
    assert bits(obj) == bits(twin)


def test_a_change_that_had_to_wait_is_not_forgotten(live, begin):
    """Runs are left alone until they are seen; confirming at once must not write such a run."""
    twin, obj = add_monkey("Twin"), add_monkey()
    session = begin(obj, cubeness=0.2)
    tick_to_rest(session)
    live.live_properties().cubeness = 0.6
    session.tick(bpy.context)
    session._last_restart = float("inf")  # the run stays young until it has ended
    live.live_properties().cubeness = 0.7
    confirm(live, session)
    select(twin)
    bpy.ops.cubic_craft.cubify(cubeness=obj.cubic_craft.cubeness)
    assert obj.cubic_craft.cubeness == pytest.approx(0.7)
    assert bits(obj) == bits(twin)


def test_a_change_restarts_within_one_tick(live, begin):
    obj = add_triangles()
    session = begin(obj)
    tick_to_rest(session)
    assert session.meshes[0].iteration > 10
    live.live_properties().cubeness = 0.8
    assert session._timer is not None, "the change has not woken it"
    before = bits(obj)
    session.tick(bpy.context)
    assert session.meshes[0].iteration * 0.001 < 1 and bits(obj) != before
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
    session = begin(obj)
    tick_to_rest(session)
    assert session._timer is None
    bpy.context.view_layer.update()  # the last change of Live itself does not wake it
    assert session._timer is None
    obj.location.x += 1.0
    bpy.context.view_layer.update()
    assert session._timer is not None
    before = session.meshes[0].iteration
    session.tick(bpy.context)
    assert session._timer is None and session.meshes[0].iteration == before, "moved is not turned"


def test_the_frame_object_restarts_it(live, begin):
    obj = add_triangles()
    frame = bpy.data.objects.new("Frame", None)
    bpy.context.collection.objects.link(frame)
    session = begin(obj, space="FRAME", frame=frame)
    assert live.live_properties().frame == "Frame"
    tick_to_rest(session)
    before = bits(obj)
    frame.rotation_euler = (0.3, 0.2, 0.5)
    bpy.context.view_layer.update()
    tick_to_rest(session)
    assert bits(obj) != before
    confirm(live, session)
    shape = bits(obj)
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == shape


def test_painted_weights_restart_it(live, begin):
    obj = add_triangles()
    group = obj.vertex_groups.new(name="Map")
    group.add(range(len(obj.data.vertices)), 1.0, "REPLACE")
    session = begin(obj, map_group="Map", cubeness=0.8)
    tick_to_rest(session)
    before = bits(obj)
    bpy.context.view_layer.update()
    group.add(range(len(obj.data.vertices) // 2), 0.0, "REPLACE")
    obj.data.update()
    bpy.context.view_layer.update()
    assert session._timer is not None
    tick_to_rest(session)
    assert bits(obj) != before
    confirm(live, session)
    shape = bits(obj)
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == shape


def test_weights_changed_before_the_last_shape_is_evaluated_count(live, begin):
    """Blender tells of both at once then, so that it looks like the update of Live alone."""
    obj = add_monkey()
    group = obj.vertex_groups.new(name="Map")
    group.add(range(len(obj.data.vertices)), 0.5, "REPLACE")
    session = begin(obj, map_group="Map")
    for _ in range(STEPS):
        session.tick(bpy.context)
        if not session.meshes[0].is_working:
            break
        bpy.context.view_layer.update()
    group.add(range(100), 1.0, "REPLACE")
    obj.data.update()
    bpy.context.view_layer.update()
    shape = bits(obj)
    tick_to_rest(session)
    assert bits(obj) != shape
    session.on(live.Event.CANCEL)


def test_a_large_mesh_is_seen_to_move_on_coarser_ones_first(live, begin, extension, monkeypatch):
    coarse_start = importlib.import_module(f"{extension.__name__}.solver.coarse_start")
    monkeypatch.setattr(coarse_start, "LEAST_VERTICES", 500)
    monkeypatch.setattr(coarse_start, "COARSEST_VERTICES", 100)
    monkeypatch.setattr(f"{live.__name__}.session.SLICE", 0.0)  # one phase in each tick
    twin, obj = add_monkey("Twin"), add_monkey()
    before = bits(obj)
    session = begin(obj, cubeness=0.6)
    mesh = session.meshes[0]
    assert mesh._run.is_on_coarser_mesh
    while mesh._run.iterations < 6:
        session.tick(bpy.context)
    assert mesh._run.is_on_coarser_mesh and mesh.iteration == 0
    assert bits(obj) != before and mesh.status[0] == "First on a coarser mesh"
    confirm(live, session)
    select(twin)
    bpy.ops.cubic_craft.cubify(cubeness=0.6)
    assert bits(obj) == bits(twin)


def test_a_handle_is_posed_live(live, begin):
    obj, _, right = add_posable()
    pin(obj, LEFT)
    empty = follow(obj, RIGHT)
    session = begin(obj, cubeness=0.0)
    tick_to_rest(session)
    before = position_of(obj.data)
    empty.location.x += 0.7
    bpy.context.view_layer.update()
    assert session._timer is not None, "the moved empty has not woken it"
    tick_to_rest(session)
    moved = position_of(obj.data) - before
    np.testing.assert_allclose(moved[right], [[0.7, 0.0, 0.0]] * len(right), atol=1e-5)
    assert not session.take_back(), "Ctrl-Z is for Blender, which has moved the empty"
    confirm(live, session)
    shape = bits(obj)
    select(obj)
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == shape


def test_a_handle_added_live_counts(live, begin):
    obj, left, _ = add_posable()
    original = position_of(obj.data)
    session = begin(obj, cubeness=0.9)
    tick_to_rest(session)
    assert np.abs(position_of(obj.data) - original)[left].max() > 1e-3
    bpy.ops.cubic_craft.handle_add(group=LEFT)
    bpy.context.view_layer.update()
    tick_to_rest(session)
    assert np.array_equal(position_of(obj.data)[left], original[left])
    live.live_properties().use_handles = False
    tick_to_rest(session)
    assert not np.array_equal(position_of(obj.data)[left], original[left])


def test_moving_object_and_handles_together_restarts_nothing(live, begin):
    obj, _, _ = add_posable()
    empty = pose(obj)
    session = begin(obj)
    tick_to_rest(session)
    done = session.meshes[0].iteration
    obj.location = (0.3, 5.1, -2.7)
    obj.rotation_euler = (0.4, 1.0, 0.2)
    bpy.context.view_layer.update()
    session.tick(bpy.context)
    assert session.meshes[0].iteration == done and session._timer is None
    assert empty.parent == obj


def test_several_objects_are_live_together(live, begin):
    twins = [add_monkey("TwinA"), add_monkey("TwinB")]
    objects = [add_monkey("A"), add_monkey("B", location=(3, 0, 0))]
    objects[1].cubic_craft.cubeness = 0.05  # the active one counts
    session = begin(*objects, cubeness=0.6)
    before = [bits(obj) for obj in objects]
    session.tick(bpy.context)
    session.tick(bpy.context)
    assert all(bits(obj) != b for obj, b in zip(objects, before, strict=True))
    confirm(live, session)
    select(*twins)
    bpy.ops.cubic_craft.cubify(cubeness=0.6)
    assert [bits(obj) for obj in objects] == [bits(obj) for obj in twins]


def test_a_mesh_of_two_objects_is_solved_once(live, begin):
    obj = add_monkey()
    other = bpy.data.objects.new("Other", obj.data)
    bpy.context.collection.objects.link(other)
    session = begin(obj, other)
    assert len(session.meshes) == 1
    assert session.mesh_of(other) is session.meshes[0]
    confirm(live, session)


def test_shape_keys_are_carried_along_in_the_preview(live, begin):
    obj = add_rich_monkey(keys=True)
    session = begin(obj, cubeness=0.8)
    tick_to_rest(session)
    shown = {key.name: bytes(_points(key)) for key in obj.data.shape_keys.key_blocks}
    confirm(live, session)
    written = {key.name: bytes(_points(key)) for key in obj.data.shape_keys.key_blocks}
    assert shown == written


def _points(key):
    values = np.empty(3 * len(key.points), np.float32)
    key.points.foreach_get("co", values)
    return values.tobytes()


# -- what happens in the middle of it ----------------------------------------------------------


def test_undo_goes_on_with_what_blender_has_brought_back(live, begin):
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    obj.location.x = 1.0
    bpy.ops.ed.undo_push(message="Moved")
    original = bits(obj)
    session = begin(obj)
    session.tick(bpy.context)
    assert bits(obj) != original
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Suzanne"]
    assert obj.location.x == 0.0
    tick_to_rest(session)
    assert not session.is_ended and not session.error
    assert bits(obj) != original
    session.on(live.Event.CANCEL)
    assert bits(obj) == original
    check_gone(live)


def test_an_undo_step_from_the_middle_comes_back_sound(live, begin):
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    original = bits(obj)
    session = begin(obj)
    session.tick(bpy.context)
    bpy.data.objects["Suzanne"].location.x = 1.0
    bpy.ops.ed.undo_push(message="Moved in the middle of Live")
    session.tick(bpy.context)
    session.on(live.Event.CANCEL)
    bpy.ops.ed.undo_push(message="After")
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Suzanne"]
    assert obj.location.x == 1.0
    assert bits(obj) == original
    check_gone(live)


def test_undo_of_the_object_ends_it(live, begin):
    bpy.ops.ed.undo_push(message="Empty")
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    session = begin(obj)
    session.tick(bpy.context)
    bpy.ops.ed.undo()
    assert "Suzanne" not in bpy.data.objects
    session.tick(bpy.context)
    assert session.is_ended and not session.error
    check_gone(live)


def test_undo_to_another_shape_starts_from_that(live, begin):
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Monkey")
    obj.data.transform(Matrix.Scale(2.0, 4, (1, 0, 0)))
    bpy.ops.ed.undo_push(message="Stretched")
    session = begin(obj)
    tick_to_rest(session)
    bpy.ops.ed.undo()
    confirm(live, session)
    obj = bpy.data.objects["Suzanne"]
    shape = bits(obj)
    select(obj)
    bpy.ops.cubic_craft.restore()
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == shape


@pytest.mark.parametrize("is_at_rest", [False, True])
@pytest.mark.parametrize("how", ["operator", "data"])
def test_deleting_the_object_ends_it(live, begin, how, is_at_rest):
    obj = add_monkey()
    session = begin(obj)
    session.tick(bpy.context)
    if is_at_rest:
        tick_to_rest(session)
    if how == "operator":
        bpy.ops.object.delete()
    else:
        bpy.data.objects.remove(obj)
    bpy.context.view_layer.update()
    assert session._timer is not None, "nothing has woken it"
    session.tick(bpy.context)
    assert session.is_ended and not session.error
    check_gone(live)


def test_deleting_one_of_two_goes_on_with_the_other(live, begin):
    a, b = add_monkey("A"), add_monkey("B")
    original = bits(a)
    session = begin(a, b)
    mesh = b.data
    session.tick(bpy.context)
    bpy.data.objects.remove(b)
    session.tick(bpy.context)
    assert not session.is_ended
    confirm(live, session)
    assert bits(a) != original
    assert bits(bpy.data.objects.new("Orphan", mesh)) == original
    check_gone(live)


def test_renaming_does_not_matter(live, begin):
    obj = add_monkey()
    session = begin(obj)
    session.tick(bpy.context)
    obj.name, obj.data.name = "Other", "Mesh"
    confirm(live, session)
    assert session.summary


def test_replacing_the_mesh_ends_it_and_gives_the_old_one_back(live, begin):
    obj = add_monkey()
    old, original = obj.data, bits(obj)
    session = begin(obj)
    session.tick(bpy.context)
    obj.data = bpy.data.meshes.new("Another")
    session.tick(bpy.context)
    assert session.is_ended
    obj.data = old
    assert bits(obj) == original
    check_gone(live)


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "VERTEX_PAINT"])
def test_another_mode_cancels_it(live, begin, mode):
    obj = add_monkey()
    original = bits(obj)
    session = begin(obj)
    session.tick(bpy.context)
    bpy.ops.object.mode_set(mode=mode)
    session.tick(bpy.context)
    assert session.is_ended and not session.error
    bpy.ops.object.mode_set(mode="OBJECT")
    assert bits(obj) == original
    check_gone(live)


def test_weight_paint_goes_on(live, begin):
    obj = add_monkey()
    session = begin(obj)
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    tick_to_rest(session)
    assert not session.is_ended
    confirm(live, session)
    bpy.ops.object.mode_set(mode="OBJECT")


def test_a_file_saved_in_the_middle_has_the_mesh_as_before(live, begin, tmp_path):
    obj = add_monkey()
    original = bits(obj)
    session = begin(obj)
    tick_to_rest(session)
    shown = bits(obj)
    path = str(tmp_path / "live.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    tick_to_rest(session)
    assert not session.is_ended and bits(obj) == shown
    bpy.ops.wm.open_mainfile(filepath=path)
    assert session.is_ended
    obj = bpy.data.objects["Suzanne"]
    assert bits(obj) == original
    assert not [a.name for a in obj.data.attributes if a.name.startswith("cubic_craft")]
    check_gone(live)


def test_a_file_written_behind_its_back_heals_when_it_is_opened(live, begin, tmp_path):
    """As Blender's autosave does, which tells nobody."""
    obj = add_monkey()
    original = bits(obj)
    session = begin(obj)
    tick_to_rest(session)
    path = str(tmp_path / "behind.blend")
    bpy.data.libraries.write(path, {bpy.context.scene})
    session.on(live.Event.CANCEL)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert bits(bpy.data.objects["Suzanne"]) == original
    check_gone(live)


def test_disabling_the_extension_ends_it(live, begin, extension):
    obj = add_monkey()
    original = bits(obj)
    session = begin(obj)
    session.tick(bpy.context)
    bpy.ops.preferences.addon_disable(module=extension.__name__)
    try:
        assert session.is_ended and bits(obj) == original
        assert not hasattr(bpy.types.WindowManager, "cubic_craft_live")
    finally:
        bpy.ops.preferences.addon_enable(module=extension.__name__)


@pytest.mark.parametrize("error", [RuntimeError("broken"), MemoryError("no memory")])
@pytest.mark.parametrize("phase", ["local_step", "global_step", "finish", "placed_positions"])
def test_an_exception_in_the_solver_loses_nothing(
    live, begin, extension, monkeypatch, caplog, phase, error
):
    obj = add_monkey()
    original = bits(obj)
    session = begin(obj)
    session.tick(bpy.context)
    solver = importlib.import_module(f"{extension.__name__}.solver")

    def fail(*_args, **_options):
        raise error

    monkeypatch.setattr(solver.Stylization, phase, fail)
    tick_to_rest(session)
    assert session.is_ended and str(error) in session.error
    assert bits(obj) == original
    assert "Live has failed" in caplog.text
    check_gone(live)


def test_an_exception_while_writing_loses_nothing(live, begin, extension, monkeypatch):
    obj = add_monkey()
    original = bits(obj)
    session = begin(obj)
    tick_to_rest(session)
    bridge = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.mesh_bridge.results")

    def fail(*_args):
        raise OSError("the disk is on fire")

    monkeypatch.setattr(bridge, "store_original", fail)
    session.on(live.Event.CONFIRM)
    tick_to_rest(session)
    assert session.is_ended and not session.summary
    assert "on fire" in session.problems[0]
    assert bits(obj) == original
    check_gone(live)


def test_another_add_on_that_resets_taichi_does_no_harm(live, begin):
    ti = pytest.importorskip("taichi")
    twin, obj = add_monkey("Twin"), add_monkey()
    session = begin(obj)
    session.tick(bpy.context)
    ti.init(arch=ti.cpu, default_fp=ti.f32, log_level=ti.WARN)
    session.tick(bpy.context)
    ti.reset()
    confirm(live, session)
    select(twin)
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == bits(twin)


def test_a_setting_that_cannot_be_used_waits_for_a_better_one(live, begin):
    obj = add_monkey()
    session = begin(obj)
    tick_to_rest(session)
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
    assert session.summary


def test_the_frame_object_may_be_deleted(live, begin):
    obj = add_monkey()
    frame = bpy.data.objects.new("Frame", None)
    bpy.context.collection.objects.link(frame)
    session = begin(obj, space="FRAME", frame=frame)
    tick_to_rest(session)
    bpy.data.objects.remove(frame)
    live.live_properties().cubeness = 0.5
    tick_to_rest(session)
    assert "Frame" in session.all_problems[0]
    live.live_properties().space = "WORLD"
    confirm(live, session)
    assert session.summary


def test_taking_back_goes_through_the_settings_first(live, begin):
    obj = add_monkey()
    original = bits(obj)
    session = begin(obj, cubeness=0.4)
    session.tick(bpy.context)
    live.live_properties().cubeness = 0.9
    session.tick(bpy.context)
    assert session.take_back()
    assert live.live_properties().cubeness == pytest.approx(0.4)
    session.tick(bpy.context)
    assert not session.is_ended
    assert session.take_back()
    assert session.is_ended and bits(obj) == original


def test_taking_back_leaves_moved_objects_to_blender(live, begin):
    obj = add_monkey()
    session = begin(obj, space="WORLD")
    session.tick(bpy.context)
    obj.rotation_euler.x = 0.5
    bpy.context.view_layer.update()
    session.tick(bpy.context)
    assert not session.take_back()
    assert not session.is_ended


def test_taking_back_ends_live_where_blender_has_undone_all_of_it(live, begin):
    obj = add_triangles()
    frame = bpy.data.objects.new("Frame", None)
    frame.rotation_euler.x = 0.5
    bpy.context.collection.objects.link(frame)
    obj.cubic_craft.space, obj.cubic_craft.frame = "FRAME", frame
    bpy.ops.ed.undo_push(message="Before Live")
    name, original = obj.name, bits(obj)
    session = begin(obj)
    tick_to_rest(session)
    bpy.data.objects["Frame"].location.x = 1.0
    bpy.ops.ed.undo_push(message="Moved")
    bpy.ops.ed.undo()
    bpy.context.view_layer.update()
    tick_to_rest(session)
    bpy.ops.ed.redo()
    bpy.context.view_layer.update()
    tick_to_rest(session)
    assert not session.take_back(), "the move is Blender's to undo"
    bpy.ops.ed.undo()
    bpy.context.view_layer.update()
    tick_to_rest(session)
    assert not session.is_ended
    assert session.take_back() and session.is_ended
    assert bits(bpy.data.objects[name]) == original
    check_gone(live)


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


def test_a_tick_keeps_to_its_slice(live, begin):
    """Loosely, because machines are noisy: many ticks, not one that does all."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=6)
    session = begin(bpy.context.object, tolerance=1e-6)
    begun = time.perf_counter()
    for _ in range(5):
        session.tick(bpy.context)
    assert not session.is_ended and session.meshes[0].is_working
    assert time.perf_counter() - begun < 5.0
