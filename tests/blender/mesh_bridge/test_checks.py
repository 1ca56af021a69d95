# SPDX-License-Identifier: GPL-3.0-or-later
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from faults import places
from rich_mesh import add_rich_monkey, cubic_like, points_of, set_points, set_position
from snapshot import differences, snapshot_object


def test_no_mesh(bridge, error):
    for obj in (
        bpy.data.objects.new("Hook", None),
        bpy.data.objects.new("Rope", bpy.data.curves.new("Rope", "CURVE")),
    ):
        for call in (bridge.check_editable, bridge.restore):
            with pytest.raises(error, match=f'"{obj.name}" is not a mesh: .*Convert'):
                call(obj)


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT"])
def test_mode(bridge, error, monkey, mode):
    bpy.ops.object.mode_set(mode=mode)
    with pytest.raises(error, match=f'"Suzanne" is in {mode.title()} Mode: go back'):
        bridge.check_editable(monkey)
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    bridge.check_editable(monkey)


def test_edit_mode_of_another_user_of_the_mesh(bridge, error, plain_monkey):
    twin = bpy.data.objects.new("Twin", plain_monkey.data)
    bpy.context.collection.objects.link(twin)
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(error, match='"Twin" shares its mesh with an object that is in Edit Mode'):
        bridge.check_editable(twin)


def test_nothing_reads_or_writes_in_edit_mode(bridge, cubify, error, monkey):
    mesh = monkey.data
    cubify(monkey)
    result = cubic_like(bridge.read_positions(mesh))
    before = snapshot_object(monkey)
    bpy.ops.object.mode_set(mode="EDIT")
    for call in (
        lambda: bridge.read_positions(mesh),
        lambda: bridge.original_positions(mesh),
        lambda: bridge.write_mesh(mesh, *result),
        lambda: bridge.write_shape_key(monkey, result[0]),
        lambda: bridge.restore(monkey),
        lambda: bridge.discard_original(mesh),
    ):
        with pytest.raises(error, match="is in Edit Mode: go back to Object Mode"):
            call()
    assert not bridge.has_original(mesh)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert bridge.has_original(mesh)
    after = snapshot_object(monkey)
    # Edit Mode itself adds and drops selections.
    ignore = ["*select*", "*attributes/order", "*attributes/active index", "*points"]
    assert differences(before, after, ignore=ignore) == []


def test_hidden(bridge, error, monkey):
    collection = bpy.data.collections.new("Room")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(monkey)
    bpy.context.scene.collection.objects.unlink(monkey)
    layer = bpy.context.view_layer.layer_collection.children["Room"]
    for hide, reason in (
        (lambda v: monkey.hide_set(v), "is hidden: show it"),
        (lambda v: setattr(monkey, "hide_viewport", v), "is hidden in viewports"),
        (lambda v: setattr(collection, "hide_viewport", v), "is in a hidden collection"),
        (lambda v: setattr(layer, "hide_viewport", v), "is in a hidden collection"),
        (lambda v: setattr(layer, "exclude", v), "is not in this view layer"),
    ):
        bridge.check_editable(monkey)
        hide(True)
        with pytest.raises(error, match=f'"Suzanne" {reason}'):
            bridge.check_editable(monkey)
        hide(False)
    bridge.check_editable(monkey)


def test_no_faces(bridge, error):
    for points, message in (
        ([(0, 0, 0), (1, 0, 0)], "fewer than 3 vertices"),
        ([], "fewer than 3 vertices"),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], "no faces"),
    ):
        mesh = bpy.data.meshes.new("Wire")
        mesh.from_pydata(points, [(0, 1)] if points else [], [])
        obj = bpy.data.objects.new("Wire", mesh)
        bpy.context.collection.objects.link(obj)
        with pytest.raises(error, match=f'"{obj.name}" has {message}: '):
            bridge.check_editable(obj)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_coordinates_without_number(bridge, error, monkey, value):
    mesh = monkey.data
    broken = bridge.read_positions(mesh)
    broken[11, 1] = value
    where = ""
    if mesh.shape_keys is None:
        set_position(mesh, broken)
    else:
        set_points(mesh, "Basis", broken)
        where = ' in shape key "Basis"'
    with pytest.raises(error, match=f'"Suzanne" has .*{where} .vertex 11, .* of 1.*delete'):
        bridge.check_editable(monkey)
    with pytest.raises(error, match=f'"{mesh.name}".*delete'):
        bridge.read_positions(mesh)


def test_shape_keys_that_do_not_fit(bridge, cubify, error, keyed_monkey):
    mesh = keyed_monkey.data
    cubify(keyed_monkey)
    mesh.vertices.add(2)
    for call in (
        lambda: bridge.check_editable(keyed_monkey),
        lambda: bridge.read_positions(mesh),
        lambda: bridge.original_positions(mesh),
    ):
        with pytest.raises(error, match=r'"Basis" of mesh "Monkey" has .*: delete the shape key'):
            call()
    assert not bridge.has_original(mesh)


@pytest.fixture
def library(tmp_path):
    """Save a file with the monkey and start an empty one."""
    add_rich_monkey(keys=True)
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    libraries: Any = bpy.data.libraries
    with libraries.load(path, link=True) as (_, wanted):
        wanted.objects = ["Suzanne"]
    obj = wanted.objects[0]
    bpy.context.collection.objects.link(obj)
    return obj


@pytest.mark.parametrize("override", [None, "object", "mesh"])
def test_linked_data(bridge, error, library, override):
    obj = library
    if override:
        obj = obj.override_create(remap_local_usages=True)
    if override == "mesh":
        mesh = obj.data.override_create(remap_local_usages=True)
        assert mesh.is_editable and obj.data == mesh
    result = cubic_like(bridge.read_positions(obj.data))
    before = snapshot_object(obj)
    for call in (
        lambda: bridge.check_editable(obj),
        lambda: bridge.write_mesh(obj.data, *result),
        lambda: bridge.write_shape_key(obj, result[0]),
        lambda: bridge.write_new_object(obj, *result),
        lambda: bridge.restore(obj),
        lambda: bridge.discard_original(obj.data),
    ):
        with pytest.raises(error, match=r"linked.*make it local"):
            call()
    assert differences(before, snapshot_object(obj)) == []
    assert not bridge.has_original(obj.data)


def test_usable_is_editable_but_for_the_coordinates(bridge, error, keyed_monkey):
    mesh = keyed_monkey.data
    points = points_of(mesh, "Wide")
    points[4] = np.nan
    set_points(mesh, "Wide", points)
    bridge.check_usable(keyed_monkey)
    with pytest.raises(error, match="not finite"):
        bridge.check_editable(keyed_monkey)
    mesh.vertices.add(2)
    for check in (bridge.check_usable, bridge.check_editable):
        with pytest.raises(error, match="delete the shape key"):
            check(keyed_monkey)
    keyed_monkey.hide_set(True)
    for check in (bridge.check_usable, bridge.check_editable):
        with pytest.raises(error, match="is hidden"):
            check(keyed_monkey)


def test_what_panels_ask_reads_no_coordinates(bridge, cubify, monkey):
    cubify(monkey)
    folder = str(Path(bridge.__file__).parent)

    def readers(call):
        called = {place.name for place in places(call, folder, in_operator=False)}
        return called & {"read_position", "read_key", "fingerprint"}

    assert not readers(lambda: bridge.check_usable(monkey))
    assert not readers(lambda: bridge.has_traces(monkey.data))
    assert readers(lambda: bridge.check_editable(monkey))
    assert "fingerprint" in readers(lambda: bridge.has_original(monkey.data))


def _cubified(cubify, change, result="MESH", *, keys=True):
    obj = add_rich_monkey(keys=keys)
    cubify(obj, result)
    return change(obj) or obj


def _enter_edit_mode(obj):
    bpy.ops.object.mode_set(mode="EDIT")


def _noted_without_vertices(obj):
    empty = bpy.data.meshes.new("Nothing")
    for name, value in obj.data.items():
        empty[name] = value
    return bpy.data.objects.new("Nothing", empty)


ODD = {
    "hook": lambda _: bpy.data.objects.new("Hook", None),
    "rope": lambda _: bpy.data.objects.new("Rope", bpy.data.curves.new("R", "CURVE")),
    "new": lambda _: bpy.data.objects.new("New", bpy.data.meshes.new("New")),
    "edited": lambda cubify: _cubified(cubify, _enter_edit_mode, "SHAPE_KEY"),
    "cleared": lambda cubify: _cubified(cubify, lambda obj: obj.data.clear_geometry()),
    "noted": lambda cubify: _cubified(cubify, _noted_without_vertices, keys=False),
    "unfit": lambda cubify: _cubified(cubify, lambda obj: obj.data.vertices.add(3), "SHAPE_KEY"),
}


@pytest.mark.parametrize("how", ODD)
def test_questions_never_fail(bridge, cubify, error, how):
    """Panels and polls ask them about whatever is selected."""
    obj = ODD[how](cubify)
    assert not bridge.has_original(obj.data)
    assert bridge.has_traces(obj.data) == (how not in ("hook", "rope", "new"))
    for check in (bridge.check_usable, bridge.check_editable):
        with pytest.raises(error, match=f'"{obj.name}"|"Monkey"'):
            check(obj)
