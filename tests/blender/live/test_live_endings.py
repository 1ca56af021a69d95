# SPDX-License-Identifier: GPL-3.0-or-later
"""What may happen to Live from outside or go wrong in it: the shape is never lost."""

import importlib
import json
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from live_steps import add_monkey, bits, check_gone, confirm, tick_to_rest, tick_to_sight
from rich_mesh import add_rich_monkey
from scene import select
from snapshot import differences, snapshot_mesh, snapshot_object


@pytest.mark.parametrize("is_at_rest", [False, True])
@pytest.mark.parametrize("how", ["operator", "data"])
def test_deleting_the_object_ends_it(live, begin, how, is_at_rest):
    obj = add_monkey()
    session = tick_to_sight(begin(obj))
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
    tick_to_sight(session)
    bpy.data.objects.remove(b)
    session.tick(bpy.context)
    assert not session.is_ended
    confirm(live, session)
    assert bits(a) != original
    assert bits(bpy.data.objects.new("Orphan", mesh)) == original
    check_gone(live)


@pytest.mark.thorough(2)
@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "VERTEX_PAINT", "TEXTURE_PAINT"])
@pytest.mark.parametrize("is_at_rest", [False, True])
def test_another_mode_confirms_it_and_is_there_afterwards(live, begin, mode, is_at_rest):
    twin, obj = add_monkey("Twin"), add_monkey()
    obj.data.uv_layers.new()
    original = bits(obj)
    session = tick_to_sight(begin(obj))
    if is_at_rest:
        tick_to_rest(session)
    bpy.ops.object.mode_set(mode=mode)
    tick_to_rest(session)
    assert session.is_ended and not session.error and not session.written.problems
    assert "mode was changed" in session.end_message and session.written.summary
    assert obj.mode == mode
    bpy.ops.object.mode_set(mode="OBJECT")
    check_gone(live)
    assert bits(obj) != original
    cubic = bits(obj)
    select(obj)
    bpy.ops.cubic_craft.restore()
    assert bits(obj) == original
    select(twin)
    bpy.ops.cubic_craft.cubify()
    assert bits(twin) == cubic, "not finished as after Enter"


def test_a_mode_that_cannot_wait_has_the_shape_so_far(live, begin, one_phase, part, monkeypatch):
    obj = add_monkey()
    original = bits(obj)
    session = tick_to_sight(begin(obj))
    shown = bits(obj)
    module = part("live.session")
    monkeypatch.setattr(module, "_PATIENCE", 0.0)
    bpy.ops.object.mode_set(mode="EDIT")
    session.tick(bpy.context)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert session.is_ended and "not converged" in session.written.summary
    assert bits(obj) == shown != original
    check_gone(live)


def test_selecting_another_mesh_confirms_it(live, begin):
    other, obj = add_monkey("Other"), add_monkey()
    original = bits(obj)
    session = tick_to_rest(begin(obj))
    shown = bits(obj)
    select(other)
    bpy.context.view_layer.update()
    tick_to_rest(session)
    assert session.is_ended and session.written.summary
    assert bits(obj) == shown != original and bits(other) == original
    assert bpy.context.object == other
    check_gone(live)


def test_selecting_what_it_depends_on_does_not_end_it(live, begin):
    target, form, hat, obj = (add_monkey(name) for name in ("Target", "Form", "Hat", "Suzanne"))
    group = obj.vertex_groups.new(name="Head")
    group.add([0, 1, 2], 1.0, "REPLACE")
    handle = obj.cubic_craft.handles.add()
    handle.group, handle.target = "Head", target
    obj.cubic_craft.form, obj.cubic_craft.form_object = "OBJECT", form
    region = obj.cubic_craft.regions.add()
    region.group, region.form, region.form_object = "Head", "OBJECT", hat
    session = tick_to_rest(begin(obj))
    empty = bpy.data.objects.new("Empty", None)
    bpy.context.collection.objects.link(empty)
    for asked_for in (target, form, hat, empty):
        select(asked_for)
        session.wake()
        tick_to_rest(session)
        assert not session.is_ended
    session.on(live.Event.CANCEL)


def test_another_scene_confirms_it(live, begin):
    obj = add_monkey()
    session = tick_to_rest(begin(obj))
    shown = bits(obj)
    first, other = bpy.context.window.scene, bpy.data.scenes.new("Other")
    bpy.context.window.scene = other
    try:
        session.look_around(bpy.context)
    finally:
        bpy.context.window.scene = first
        bpy.data.scenes.remove(other)
    assert session.is_ended and session.written.summary and not session.written.problems
    assert bits(obj) == shown
    check_gone(live)


def test_after_cancelling_a_click_starts_where_it_was(live, begin):
    obj = add_monkey()
    session = begin(obj)
    live.live_properties().cubeness = 0.9
    tick_to_rest(session)
    session.on(live.Event.CANCEL)
    own = obj.cubic_craft.cubeness
    assert own != 0.9
    session = tick_to_rest(begin(obj))
    assert live.live_properties().cubeness == pytest.approx(0.9)
    assert session.take_back()
    assert live.live_properties().cubeness == own, "Ctrl-Z goes back to the object's own"
    session.on(live.Event.CANCEL)
    session = begin(obj, cubeness=0.2)
    assert live.live_properties().cubeness == pytest.approx(0.2), "changed since by hand"
    session.on(live.Event.CANCEL)


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
@pytest.mark.parametrize("is_at_rest", [False, True])
def test_a_file_saved_in_the_middle_has_what_is_seen(live, begin, tmp_path, result, is_at_rest):
    obj = add_rich_monkey(keys=result != "SHAPE_KEY")
    obj.cubic_craft.refine = "OFF"
    select(obj)
    before = snapshot_mesh(obj.data), snapshot_object(obj)
    session = tick_to_sight(begin(obj, result=result))
    seen = obj if result != "NEW_OBJECT" else bpy.data.objects[f"{obj.name} Cubic"]
    objects = set(bpy.data.objects.keys())
    live.live_properties().cubeness = 0.7
    if is_at_rest:
        tick_to_rest(session)
    else:
        session.tick(bpy.context)
        tick_to_sight(session)
    shown, name_seen, name = bits(seen), seen.name, obj.name
    path = str(tmp_path / "live.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    assert set(bpy.data.objects.keys()) == objects and bpy.context.object == obj
    assert obj.visible_get() and not obj.hide_render and obj.select_get()
    if is_at_rest:
        tick_to_rest(session)
        assert not session.is_ended and bits(bpy.data.objects[name_seen]) == shown
    session.on(live.Event.CANCEL)
    check_gone(live)
    # Blender 4.2 makes the group of our settings when it is first looked at.
    ignore = ("custom/custom cubic_craft", "*is_evaluated*")
    for one, other in zip(before, (snapshot_mesh(obj.data), snapshot_object(obj)), strict=True):
        assert not differences(one, other, ignore)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert not bpy.data.objects[name].hide_get(), "what is followed is not in the way"
    obj = bpy.data.objects[name_seen]
    assert obj.cubic_craft.cubeness == pytest.approx(0.7)
    key = obj.data.shape_keys.key_blocks["Cubic"] if result == "SHAPE_KEY" else None
    assert key is None or key.value == 1.0
    values = np.empty(3 * len(obj.data.vertices), np.float32)
    (key.data if key else obj.data.vertices).foreach_get("co", values)
    assert values.tobytes() == shown
    select(obj)
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert not [a.name for a in obj.data.attributes if a.name.startswith("cubic_craft")]
    check_gone(live)


def test_it_goes_on_when_the_file_cannot_be_saved(live, begin, tmp_path):
    obj = add_monkey()
    session = tick_to_rest(begin(obj))
    shown = bits(obj)
    with pytest.raises(RuntimeError, match="not"):
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "missing" / "live.blend"), copy=True)
    tick_to_rest(session)
    assert not session.is_ended and bits(obj) == shown


@pytest.mark.parametrize("cubified", [False, True])
def test_a_file_written_behind_its_back_shows_what_was_seen(live, begin, tmp_path, cubified):
    """As Blender's autosave does, which tells nobody."""
    obj = add_rich_monkey(keys=True)
    obj.cubic_craft.refine = "OFF"
    select(obj)
    original = snapshot_mesh(obj.data)
    if cubified:
        bpy.ops.cubic_craft.cubify()
    before = bits(obj)
    session = tick_to_rest(begin(obj, cubeness=0.7))
    shown = bits(obj)
    path = str(tmp_path / "behind.blend")
    bpy.data.libraries.write(path, {bpy.context.scene})
    session.on(live.Event.CANCEL)
    assert bits(obj) == before != shown
    name = obj.name
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.data.objects[name]
    check_gone(live)
    assert bits(obj) == shown
    assert obj.cubic_craft.cubeness == pytest.approx(0.7)
    select(obj)
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    # The values of the keys are those of the scene.
    assert not differences(original, snapshot_mesh(obj.data), ("*is_evaluated*",))


def test_a_file_written_behind_its_back_is_as_before_where_a_key_was_to_be_written(
    live, begin, tmp_path
):
    obj = add_monkey()
    original = bits(obj)
    session = tick_to_rest(begin(obj, result="SHAPE_KEY"))
    path = str(tmp_path / "behind.blend")
    bpy.data.libraries.write(path, {bpy.context.scene})
    session.on(live.Event.CANCEL)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.data.objects["Suzanne"]
    select(obj)
    assert bits(obj) == original and obj.data.shape_keys is None
    assert not bpy.ops.cubic_craft.restore.poll()


def test_a_preview_that_is_found_in_edit_mode_ends(live, begin, extension, tmp_path, caplog, part):
    """As after an undo while the extension is switched off."""
    session = tick_to_rest(begin(add_monkey(), cubeness=0.7))
    path = str(tmp_path / "behind.blend")
    bpy.data.libraries.write(path, {bpy.context.scene})
    session.on(live.Event.CANCEL)
    original = bits(bpy.data.objects["Suzanne"])
    stale = part("live.stale_previews")
    stale.unregister()
    try:
        bpy.ops.wm.open_mainfile(filepath=path)
        obj = bpy.data.objects["Suzanne"]
        assert bits(obj) != original
        select(obj)
        bpy.ops.object.mode_set(mode="EDIT")
        stale._keep()
        bpy.ops.object.mode_set(mode="OBJECT")
    finally:
        stale.register()
    assert bits(obj) == original and not caplog.records
    check_gone(live)


@pytest.mark.parametrize("outcome", [None, 1, {"values": {}}, {"values": {"result": "MESH"}}])
def test_a_file_that_says_anything_else_heals(live, begin, tmp_path, outcome):
    obj = add_monkey()
    original = bits(obj)
    session = tick_to_rest(begin(obj))
    note = json.loads(obj.data["cubic_craft_note"])
    note["live"]["outcome"] = outcome
    obj.data["cubic_craft_note"] = json.dumps(note)
    path = str(tmp_path / "behind.blend")
    bpy.data.libraries.write(path, {bpy.context.scene})
    session.on(live.Event.CANCEL)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert bits(bpy.data.objects["Suzanne"]) == original
    check_gone(live)


def test_disabling_the_extension_ends_it_with_what_is_seen(live, begin, extension):
    obj = add_monkey()
    session = tick_to_rest(begin(obj))
    shown = bits(obj)
    bpy.ops.preferences.addon_disable(module=extension.__name__)
    try:
        assert session.is_ended and bits(obj) == shown
        assert not hasattr(bpy.types.WindowManager, "cubic_craft_live")
    finally:
        bpy.ops.preferences.addon_enable(module=extension.__name__)


@pytest.mark.thorough(3)
@pytest.mark.parametrize("error", [RuntimeError("broken"), MemoryError("no memory")])
@pytest.mark.parametrize("phase", ["local_step", "global_step", "finish", "placed_positions"])
def test_an_exception_in_the_solver_loses_nothing(
    live, begin, one_phase, extension, monkeypatch, caplog, phase, error
):
    obj = add_monkey()
    original = bits(obj)
    session = tick_to_sight(begin(obj))
    solver = importlib.import_module(f"{extension.__name__}.solver")

    def fail(*_args, **_options):
        raise error

    monkeypatch.setattr(solver.Stylization, phase, fail)
    tick_to_rest(session)
    assert session.is_ended and str(error) in session.error
    assert bits(obj) == original
    assert "Live has failed" in caplog.text
    check_gone(live)


def test_a_run_that_is_lost_on_the_gpu_can_be_started_again(
    live, begin, one_phase, extension, monkeypatch
):
    obj = add_monkey()
    session = tick_to_sight(begin(obj))
    solver = importlib.import_module(f"{extension.__name__}.solver")

    def fail(*_args):
        raise solver.CubicCraftError("lost")

    with monkeypatch.context() as context:
        context.setattr(solver.Stylization, "local_step", fail)
        tick_to_rest(session)
    assert not session.is_ended and not session.error
    assert session.all_problems == [f'"{obj.name}": lost']
    live.live_properties().cubeness = 0.9
    confirm(live, session)


def test_an_exception_while_writing_loses_nothing(live, begin, extension, monkeypatch):
    obj = add_monkey()
    original = bits(obj)
    session = tick_to_rest(begin(obj))
    room = f"{extension.__name__}.cubic_craft_addon.mesh_bridge.result"
    results = importlib.import_module(f"{room}.results")

    def fail(*_args):
        raise OSError("the disk is on fire")

    monkeypatch.setattr(results, "store_original", fail)
    session.on(live.Event.CONFIRM)
    tick_to_rest(session)
    assert session.is_ended and not session.written.summary
    assert "on fire" in session.written.problems[0]
    assert bits(obj) == original
    check_gone(live)


def test_another_add_on_that_resets_taichi_does_no_harm(live, begin, one_phase):
    ti = pytest.importorskip("taichi")
    twin, obj = add_monkey("Twin"), add_monkey()
    session = tick_to_sight(begin(obj))
    ti.init(arch=ti.cpu, default_fp=ti.f32, log_level=ti.WARN)
    session.tick(bpy.context)
    ti.reset()
    confirm(live, session)
    select(twin)
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == bits(twin)


def test_the_cursor_says_that_blender_computes_where_there_is_a_window(part):
    waiting = part("screen.redraw").waiting
    said = []
    window = SimpleNamespace(cursor_modal_set=said.append, cursor_modal_restore=said.clear)
    for each in (None, window):
        with waiting(each):
            assert said == (["WAIT"] if each else [])
        assert said == []
