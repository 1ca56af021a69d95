# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify in slices, as it runs beside Blender: same bits, and nothing written before the end."""

import importlib

import bpy
import pytest
from live_steps import add_monkey, bits
from mathutils import Matrix
from scene import change_settings, cubify, select


@pytest.fixture
def package(extension):
    return f"{extension.__name__}.cubic_craft_addon"


@pytest.fixture
def start(package):
    """Return a function that starts a watched job on objects, with the settings of the first."""
    jobs = importlib.import_module(f"{package}.job")
    choice = importlib.import_module(f"{package}.settings.overrides")

    def begin(*objects):
        select(*objects)
        names = [name for name in choice.ALL if name not in choice.OF_EACH_OBJECT]
        values = choice.values_of(objects[0].cubic_craft, tuple(names))
        watched = jobs.WatchedJob(jobs.Job(choice.SettingsOverrides(values), list(objects)))
        watched.advance(0.0)
        watched.watch(bpy.context.window)
        return watched

    yield begin
    if jobs.current() is not None:
        jobs.current().cancel()


def solve(watched):
    """Advance to the end in the smallest slices, and return what was said on the way."""
    said = [watched.step]
    for _ in range(5000):
        if watched.is_solved or watched.reason is not None:
            return said
        watched.tick()
        said.append(watched.step)
    raise AssertionError("it does not come to an end")


@pytest.fixture(autouse=True)
def smallest_slices(package, monkeypatch):
    importlib.import_module(f"{package}.job.watched")
    monkeypatch.setattr(f"{package}.job.watched._SLICE", 0.0)


def check_nothing_left(package):
    watched = importlib.import_module(f"{package}.job.watched")
    assert watched.current() is None
    for name, handler in watched._HANDLERS:
        assert handler not in getattr(bpy.app.handlers, name)


def test_slices_give_the_bits_of_the_script(package, start):
    one, other = add_monkey("One"), add_monkey("Other", location=(5, 0, 0))
    other.data.transform(Matrix.Diagonal((1, 1, 0.7, 1)))
    for obj in (one, other):
        change_settings(obj, together="PARTS", keep_apart=True)
    before = [bits(one), bits(other)]
    watched = start(one, other)
    said = solve(watched)
    assert [bits(one), bits(other)] == before, "written before all was solved"
    texts = [step.texts[0] for step in said]
    assert texts[0] == '1 of 2: Preparing "One"'
    assert any(text.startswith("2 of 2: ") and " %" in text for text in texts)
    factors = [step.factor for step in said]
    assert factors == sorted(factors) and factors[0] == 0.0
    assert 0.75 <= factors[-1] <= 1.0, "how long Keep Apart will take is not known before"
    summary, problems = watched.write()
    assert summary.startswith("Cubified 2 meshes in")
    assert not problems
    check_nothing_left(package)
    after = [bits(one), bits(other)]
    assert after[0] != before[0] and after[1] != before[1]
    bpy.ops.cubic_craft.restore()
    assert [bits(one), bits(other)] == before
    assert bpy.ops.cubic_craft.cubify(together="PARTS") == {"FINISHED"}
    assert [bits(one), bits(other)] == after


def test_a_large_mesh_is_announced_before_its_setup(start):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=130, y_subdivisions=130)
    watched = start(bpy.context.object)
    assert watched.step.is_long and watched.step.texts[0] == 'Preparing "Grid"'
    watched.cancel()
    assert not start(add_monkey()).step.is_long


def test_while_it_runs_the_buttons_say_so(start):
    obj = add_monkey()
    cubify()
    watched = start(obj)
    for operator in (
        bpy.ops.cubic_craft.cubify,
        bpy.ops.cubic_craft.live,
        bpy.ops.cubic_craft.restore,
        bpy.ops.cubic_craft.apply,
        bpy.ops.cubic_craft.flatten,
        bpy.ops.cubic_craft.auto_orient,
        bpy.ops.cubic_craft.handle_pin_selection,
    ):
        assert not operator.poll()
    with pytest.raises(RuntimeError, match="Cubify is running; press Esc to cancel it"):
        cubify()
    assert bpy.ops.cubic_craft.cubify_cancel() == {"FINISHED"}
    assert watched.reason == ""
    assert not bpy.ops.cubic_craft.cubify_cancel.poll() and bpy.ops.cubic_craft.cubify.poll()


def test_cancelling_leaves_nothing(package, start):
    obj = add_monkey()
    before = bits(obj)
    watched = start(obj)
    watched.tick()
    watched.cancel()
    assert bits(obj) == before and not obj.data.keys() and not obj.cubic_craft.status
    check_nothing_left(package)
    assert cubify() == {"FINISHED"}


def remove(obj):
    bpy.data.objects.remove(obj)


def unlink(obj):
    obj.use_fake_user = True
    bpy.context.collection.objects.unlink(obj)


def swap(obj):
    obj.data = obj.data.copy()


def edit(obj):
    bpy.ops.object.mode_set(mode="EDIT")


@pytest.mark.parametrize("change", [remove, unlink, swap, edit])
def test_what_makes_it_impossible_ends_it(package, start, change):
    obj = add_monkey()
    mesh = obj.data
    watched = start(obj)
    watched.tick()
    change(obj)
    watched.tick()
    assert watched.reason
    check_nothing_left(package)
    if change is edit:
        assert watched.reason == '"Suzanne" is being edited'
        bpy.ops.object.mode_set(mode="OBJECT")
    assert not mesh.keys() and len(mesh.vertices) == 507


def test_another_file_ends_it(package, start):
    watched = start(add_monkey())
    bpy.ops.wm.read_homefile(use_empty=True)
    assert watched.reason == "another file was opened"
    check_nothing_left(package)


def test_undo_ends_it_before_the_data_is_gone(package, start):
    obj = add_monkey()
    bpy.ops.ed.undo_push(message="Add")
    obj.location.x = 1
    bpy.ops.ed.undo_push(message="Move")
    watched = start(obj)
    bpy.ops.ed.undo()
    assert watched.reason == "another step was undone or redone"
    check_nothing_left(package)


def move_a_vertex(obj):
    obj.data.vertices[0].co.x += 1


def flip(obj):
    obj.data.flip_normals()


def stretch(obj):
    obj.scale.z = 2
    bpy.context.view_layer.update()


@pytest.mark.parametrize("change", [move_a_vertex, flip, stretch])
def test_what_was_changed_is_not_written(start, change):
    one, other = add_monkey("One"), add_monkey("Other", location=(5, 0, 0))
    one.cubic_craft.together = "PARTS"
    watched = start(one, other)
    watched.tick()  # now it is read
    change(one)
    before = bits(one), bits(other)
    solve(watched)
    summary, problems = watched.write()
    assert summary.startswith("Cubified:")
    assert '"One" was changed while Cubify ran; click Cubify again' in problems
    assert bits(one) == before[0] and bits(other) != before[1]


def test_an_object_that_is_moved_alone_is_written(start):
    obj = add_monkey()
    before = bits(obj)
    watched = start(obj)
    obj.location.x = 3
    bpy.context.view_layer.update()
    solve(watched)
    watched.write()
    assert bits(obj) != before


def test_a_pose_that_was_settled_for_it_is_put_back(start):
    """The mesh was edited since it was posed: its pose is the rest, but only once it is written."""
    obj = add_monkey()
    cubify()
    obj.data.vertices[3].co.x += 0.1
    obj.data.update()
    obj.vertex_groups.new(name="Ear").add(range(50), 1.0, "REPLACE")
    handle = obj.cubic_craft.handles.add()
    handle.group = "Ear"
    handle.is_baked = True
    handle.baked = Matrix.Translation((0, 0, 1))
    obj.cubic_craft.start = "HERE"
    watched = start(obj)
    assert handle.is_baked and handle.rest != handle.baked
    watched.cancel()
    assert handle.is_baked and handle.rest != handle.baked
    watched = start(obj)
    solve(watched)
    watched.write()
    assert not handle.is_baked and handle.rest == Matrix.Translation((0, 0, 1))
