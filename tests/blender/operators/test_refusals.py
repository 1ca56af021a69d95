# SPDX-License-Identifier: GPL-3.0-or-later
"""What cannot be cubified is refused by name, and whatever goes wrong, nothing has changed."""

import importlib

import bpy
import pytest
from rich_mesh import add_rich_monkey
from scene import add_monkey, cubify, given, select
from snapshot import differences, snapshot_object, unchanged

# Before Blender 5 the settings appear among the object's custom properties once they are read.
READ = ("custom/custom cubic_craft",)


def _empty(obj):
    obj.data.clear_geometry()


def _no_faces(obj):
    obj.data.clear_geometry()
    obj.data.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1)], [])


def _not_finite(obj):
    obj.data.vertices[5].co.x = float("nan")


def _hidden(obj):
    obj.hide_set(True)
    bpy.context.view_layer.objects.active = obj


def _all_pinned(obj):
    obj.vertex_groups.new(name="All").add(range(len(obj.data.vertices)), 1.0, "REPLACE")
    obj.cubic_craft.handles.add().group = "All"


def _missing_group(obj):
    obj.cubic_craft.handles.add().group = "Ears"


def _no_group(obj):
    obj.cubic_craft.handles.add()


@pytest.mark.parametrize(
    ("spoil", "options", "message"),
    [
        (_empty, {}, "Suzanne.*fewer than 3 vertices"),
        (_no_faces, {}, "Suzanne.*no faces"),
        (_not_finite, {}, "Suzanne.*finite"),
        (_hidden, {}, "Suzanne.*hidden"),
        (_all_pinned, {}, "Suzanne.*all vertices are pinned"),
        (None, {"handles": [given("Ears")]}, "Suzanne.*Ears"),
        (_missing_group, {}, "Suzanne.*no vertex group.*Ears"),
        (_no_group, {}, "handle 1 of .*Suzanne.*no vertex group"),
        (None, {"map_group": "Ears"}, "Suzanne.*Ears"),
        (None, {"space": "FRAME"}, "Suzanne.*frame object"),
        (None, {"space": "FRAME", "frame": "Nobody"}, "no object.*Nobody"),
    ],
)
@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_refusals_name_the_object_and_change_nothing(spoil, options, message, result):
    obj = add_monkey()
    if spoil:
        spoil(obj)
    bpy.context.view_layer.update()
    with unchanged(obj, READ):
        objects = len(bpy.data.objects)
        with pytest.raises(RuntimeError, match=message):
            cubify(result=result, **options)
    assert len(bpy.data.objects) == objects


def test_edit_mode_and_no_mesh_fail_the_poll_with_a_message():
    add_monkey()
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(RuntimeError, match="Switch to Object Mode first"):
        cubify()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = None
    with pytest.raises(RuntimeError, match="Select a mesh object first"):
        cubify()


def test_instances_are_not_said_to_be_nothing():
    collection = bpy.data.collections.new("Parts")
    collection.objects.link(add_monkey())
    instance = bpy.data.objects.new("Instance", None)
    instance.instance_type, instance.instance_collection = "COLLECTION", collection
    bpy.context.scene.collection.objects.link(instance)
    select(instance)
    with pytest.raises(RuntimeError, match='"Instance" shows instances of a collection'):
        cubify()


def test_what_is_missing_with_its_file_is_said_to_be_missing(tmp_path):
    add_monkey()
    library = tmp_path / "library.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(library))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
        wanted.objects = ["Suzanne"]
    linked = bpy.data.objects["Suzanne"]
    own = bpy.data.objects.new("Own", linked.data)
    for obj in (linked, own):
        bpy.context.scene.collection.objects.link(obj)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    library.unlink()
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    for name in ("Suzanne", "Own"):
        select(bpy.data.objects[name])
        with pytest.raises(RuntimeError, match=f'"{name}" is linked from .*where it is missing'):
            cubify()


def test_absolute_shape_keys_are_refused_before_anything_is_solved(part, monkeypatch, capfd):
    obj = add_rich_monkey(keys=True)
    obj.data.shape_keys.use_relative = False
    select(obj)
    pipeline = part("run.pipeline")
    monkeypatch.setattr(pipeline, "start", None)
    with unchanged(obj, READ), pytest.raises(RuntimeError, match="has absolute shape keys"):
        cubify(result="SHAPE_KEY")
    assert "Traceback" not in "".join(capfd.readouterr())


@pytest.mark.parametrize(
    ("result", "is_deformed", "is_behind"),
    [
        ("MESH", False, True),
        ("MESH", True, True),
        ("SHAPE_KEY", False, True),
        ("SHAPE_KEY", True, False),
        ("NEW_OBJECT", False, False),
    ],
)
def test_hair_that_does_not_follow_is_named(capfd, result, is_deformed, is_behind):
    obj = add_monkey()
    hair = bpy.data.objects.new("Fur", bpy.data.hair_curves.new("Fur"))
    hair.data.surface = obj
    bpy.context.scene.collection.objects.link(hair)
    if is_deformed:
        hair.modifiers.new("Deform", "NODES")
    select(obj)
    assert cubify(result=result, max_iterations=2) == {"FINISHED"}
    said = "".join(capfd.readouterr())
    assert (f'Hair "Fur" does not follow "{obj.name}"' in said) == is_behind


def test_an_exception_in_the_solver_changes_nothing(part, monkeypatch):
    obj, other = add_rich_monkey(keys=True), add_monkey("Other")
    select(other, obj)
    before = [snapshot_object(o) for o in (obj, other)]
    pipeline = part("run.pipeline")
    original = pipeline.start
    calls = []

    def fail_second(*arguments):
        calls.append(arguments)
        if len(calls) == 2:
            raise MemoryError("no memory left")
        return original(*arguments)

    monkeypatch.setattr(pipeline, "start", fail_second)
    with pytest.raises(RuntimeError, match="not enough memory"):
        cubify(together="PARTS")  # one after the other
    for o, taken in zip((obj, other), before, strict=True):
        assert differences(taken, snapshot_object(o), READ) == []


def test_a_refusal_by_the_solver_names_the_object_once(extension, monkeypatch):
    add_monkey()
    memory = importlib.import_module(f"{extension.__name__}.solver.surface.memory")
    monkeypatch.setattr(memory, "free_memory", lambda: 1_000_000)
    with pytest.raises(RuntimeError, match=r"507 vertices need about .* of memory") as caught:
        cubify()
    assert str(caught.value).count("Suzanne") == 1
