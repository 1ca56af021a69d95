# SPDX-License-Identifier: GPL-3.0-or-later
import itertools

import bpy
import numpy as np
import pytest
from previewed import NOTE, STATES, add_monkey, live_attributes, show_some
from rich_mesh import cubic_like, points_of, position_of
from scene import add_copy
from snapshot import POSITIONS, SHAPE_KEY_POINTS, STORED, differences, snapshot_object, unchanged


@pytest.mark.parametrize("state", STATES)
def test_end_puts_all_bits_back(bridge, state):
    obj = add_monkey(bridge, state)
    mesh = obj.data
    before = snapshot_object(obj)
    traces = bridge.has_traces(mesh)
    preview = show_some(bridge, mesh)
    changed = differences(before, snapshot_object(obj), ignore=STORED)
    assert changed != []
    changed = differences(before, snapshot_object(obj), POSITIONS + SHAPE_KEY_POINTS + STORED)
    assert changed == []
    assert bridge.has_preview(mesh) and bridge.has_traces(mesh)
    assert preview.needs_rotations == ("keys" in state)
    assert bridge.end_preview(mesh)
    assert differences(before, snapshot_object(obj)) == []
    assert not bridge.has_preview(mesh) and bridge.has_traces(mesh) == traces
    assert not bridge.end_preview(mesh)


@pytest.mark.parametrize("state", STATES)
def test_shows_what_write_mesh_would_write(bridge, state):
    obj = add_monkey(bridge, state)
    written = add_copy(obj)
    result = cubic_like(bridge.original_positions(obj.data), 2)
    bridge.write_mesh(written.data, *result)
    show_some(bridge, obj.data)
    assert position_of(obj.data).tobytes() == position_of(written.data).tobytes()
    keys = written.data.shape_keys.key_blocks if written.data.shape_keys else ()
    for key in keys:
        shown = points_of(obj.data, key.name)
        assert shown.tobytes() == points_of(written.data, key.name).tobytes()
    if "Cubic" in state:
        assert points_of(obj.data, "Cubic").tobytes() == position_of(obj.data).tobytes()


@pytest.mark.parametrize("key_value", [0.0, 0.4, 1.0])
def test_the_picture_does_not_depend_on_the_value_of_our_key(bridge, key_value):
    obj = add_monkey(bridge, "Cubic")
    obj.modifiers.clear()
    obj.data.shape_keys.key_blocks["Cubic"].value = key_value
    show_some(bridge, obj.data)
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    assert np.abs(position_of(seen) - position_of(obj.data)).max() < 1e-6


@pytest.mark.thorough(14)
@pytest.mark.parametrize(
    ("state", "result"),
    [
        *itertools.product(STATES, ["MESH", "SHAPE_KEY", "FORGET", "NEW_OBJECT"]),
        *((state, "RESTORE") for state in STATES[2:]),
    ],
)
def test_other_calls_end_it_first(bridge, state, result):
    obj = add_monkey(bridge, state)
    made = cubic_like(bridge.original_positions(obj.data), 5)
    calls = {
        "MESH": lambda o: bridge.write_mesh(o.data, *made),
        "SHAPE_KEY": lambda o: bridge.write_shape_key(o, made[0]),
        "RESTORE": bridge.restore,
        "FORGET": lambda o: bridge.discard_original(o.data),
        "NEW_OBJECT": lambda o: bridge.write_new_object(o, *made),
    }
    other = add_copy(obj)
    written = calls[result](other) or other
    expected = snapshot_shapes(written)
    show_some(bridge, obj.data)
    written = calls[result](obj) or obj
    assert snapshot_shapes(written) == expected
    assert live_attributes(written.data) == []
    assert bridge.has_preview(obj.data) == (result == "NEW_OBJECT")


def snapshot_shapes(obj):
    keys = obj.data.shape_keys.key_blocks if obj.data.shape_keys else ()
    shapes = {key.name: points_of(obj.data, key.name).tobytes() for key in keys}
    ours = [a.name for a in obj.data.attributes if a.name.startswith("cubic_craft")]
    return shapes, position_of(obj.data).tobytes(), ours, obj.data.get(NOTE)


def test_position_that_differs_from_the_basis(bridge, keyed_monkey):
    mesh = keyed_monkey.data
    flat = np.float32(position_of(mesh) + 0.25).ravel()
    mesh.attributes["position"].data.foreach_set("vector", flat)
    with unchanged(keyed_monkey):
        show_some(bridge, mesh)
        bridge.end_preview(mesh)


def test_edit_mode_and_changed_meshes_are_refused(bridge, error, plain_monkey):
    mesh = plain_monkey.data
    base = bridge.read_positions(mesh)
    preview = bridge.Preview(mesh)
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(error, match="Edit Mode"):
        preview.show(mesh, base)
    bpy.ops.object.mode_set(mode="OBJECT")
    bridge.end_preview(mesh)
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(error, match="Edit Mode"):
        bridge.Preview(mesh)
    bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(error, match="changed while a preview"):  # it has ended
        preview.show(mesh, base)
    assert position_of(mesh).tobytes() == base.tobytes()
    preview = bridge.Preview(mesh)
    mesh.vertices.add(1)
    with pytest.raises(error, match="changed while a preview"):
        preview.show(mesh, base)


def test_mesh_without_vertices(bridge):
    mesh = bpy.data.meshes.new("Nothing")
    bridge.Preview(mesh).show(mesh, np.empty((0, 3), np.float32))
    assert bridge.end_preview(mesh)
    assert not bridge.has_traces(mesh)


def test_end_all(bridge):
    monkeys = [add_monkey(bridge, state) for state in ("plain", "keys", "cubified", "plain")]
    before = [snapshot_object(obj) for obj in monkeys]
    meshes = [obj.data for obj in monkeys]
    for mesh in meshes[:3]:
        show_some(bridge, mesh)
    assert sorted(bridge.end_all_previews()) == sorted(mesh.name for mesh in meshes[:3])
    assert not any(bridge.has_preview(mesh) for mesh in meshes)
    for obj, taken in zip(monkeys, before, strict=True):
        assert differences(taken, snapshot_object(obj)) == []
    assert bridge.end_all_previews() == []
