# SPDX-License-Identifier: GPL-3.0-or-later
"""What may happen to Live from outside or go wrong in it: the shape is never lost."""

import importlib

import bpy
import pytest
from live_steps import add_monkey, bits, check_gone, confirm, tick_to_rest, tick_to_sight
from scene import select


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


def test_renaming_does_not_matter(live, begin):
    obj = add_monkey()
    session = tick_to_sight(begin(obj))
    obj.name, obj.data.name = "Other", "Mesh"
    confirm(live, session)
    assert session.summary


def test_replacing_the_mesh_ends_it_and_gives_the_old_one_back(live, begin):
    obj = add_monkey()
    old, original = obj.data, bits(obj)
    session = tick_to_sight(begin(obj))
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
    session = tick_to_sight(begin(obj))
    bpy.ops.object.mode_set(mode=mode)
    session.tick(bpy.context)
    assert session.is_ended and not session.error
    bpy.ops.object.mode_set(mode="OBJECT")
    assert bits(obj) == original
    check_gone(live)


def test_a_file_saved_in_the_middle_has_the_mesh_as_before(live, begin, tmp_path):
    obj = add_monkey()
    original = bits(obj)
    session = tick_to_rest(begin(obj))
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


def test_it_goes_on_when_the_file_cannot_be_saved(live, begin, tmp_path):
    obj = add_monkey()
    session = tick_to_rest(begin(obj))
    shown = bits(obj)
    with pytest.raises(RuntimeError, match="not"):
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "missing" / "live.blend"), copy=True)
    tick_to_rest(session)
    assert not session.is_ended and bits(obj) == shown


def test_a_file_written_behind_its_back_heals_when_it_is_opened(live, begin, tmp_path):
    """As Blender's autosave does, which tells nobody."""
    obj = add_monkey()
    original = bits(obj)
    session = tick_to_rest(begin(obj))
    path = str(tmp_path / "behind.blend")
    bpy.data.libraries.write(path, {bpy.context.scene})
    session.on(live.Event.CANCEL)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert bits(bpy.data.objects["Suzanne"]) == original
    check_gone(live)


def test_disabling_the_extension_ends_it(live, begin, extension):
    obj = add_monkey()
    original = bits(obj)
    session = tick_to_sight(begin(obj))
    bpy.ops.preferences.addon_disable(module=extension.__name__)
    try:
        assert session.is_ended and bits(obj) == original
        assert not hasattr(bpy.types.WindowManager, "cubic_craft_live")
    finally:
        bpy.ops.preferences.addon_enable(module=extension.__name__)


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
    assert session.is_ended and not session.summary
    assert "on fire" in session.problems[0]
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
