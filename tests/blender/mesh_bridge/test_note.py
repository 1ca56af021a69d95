# SPDX-License-Identifier: GPL-3.0-or-later
"""What we keep on a mesh: told apart from the artist's own, found and removed also when stale."""

import json

import bpy
import numpy as np
import pytest
from rich_mesh import cubic_like, points_of, position_of
from snapshot import differences, snapshot_object

NOTE = "cubic_craft_note"
KEY = {"name": "Wide", "fingerprint": "0", "base": "0", "offsets": [], "made_basis": False}


def cubify(bridge, obj, result="MESH", seed=0):
    positions, rotations = cubic_like(bridge.original_positions(obj.data), seed)
    if result == "MESH":
        bridge.write_mesh(obj.data, positions, rotations)
    else:
        bridge.write_shape_key(obj, positions)


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY"])
def test_property_of_the_artist_called_cubic_craft(bridge, monkey, result):
    monkey.data["cubic_craft"] = "rounded by hand"
    before = snapshot_object(monkey)
    for seed in (1, 2):
        cubify(bridge, monkey, result, seed)
        assert monkey.data["cubic_craft"] == "rounded by hand"
    bridge.restore(monkey)
    assert differences(before, snapshot_object(monkey)) == []


@pytest.mark.parametrize(
    "value",
    [
        3,
        "text",
        "[" * 100_000,
        "[]",
        '{"version": 1}',
        {"mesh": 1},
        json.dumps({"version": 0, "key": KEY}),
        json.dumps({"version": 1, "key": KEY, "mine": 1}),
        json.dumps({"version": 1, "key": KEY | {"base": 1}}),
        json.dumps({"version": 1, "key": KEY | {"offsets": ["a"]}}),
        json.dumps({"version": 1, "mesh": {"fingerprint": "0"}}),
        json.dumps({"version": 1, "mesh": {"fingerprint": "0", "keys": [1]}}),
    ],
)
def test_property_of_others_under_our_name_is_never_touched(bridge, error, keyed_monkey, value):
    mesh = keyed_monkey.data
    mesh[NOTE] = value
    before = snapshot_object(keyed_monkey)
    objects = len(bpy.data.objects)
    positions, rotations = cubic_like(bridge.original_positions(mesh))
    assert not bridge.has_original(mesh) and not bridge.has_traces(mesh)
    bridge.discard_original(mesh)
    for call in (
        lambda: bridge.check_usable(keyed_monkey),
        lambda: bridge.write_mesh(mesh, positions, rotations),
        lambda: bridge.write_shape_key(keyed_monkey, positions),
        lambda: bridge.write_new_object(keyed_monkey, positions, rotations),
    ):
        with pytest.raises(error, match=f'"Monkey" has a custom property "{NOTE}".*rename'):
            call()
    assert differences(before, snapshot_object(keyed_monkey)) == []
    assert len(bpy.data.objects) == objects
    with pytest.raises(error, match="cubify it first"):
        bridge.restore(keyed_monkey)


def test_valid_note_is_not_in_the_way(bridge, keyed_monkey):
    """The opposite of the above: none of those is refused for how it is made here."""
    keyed_monkey.data[NOTE] = json.dumps({"version": 1, "key": KEY})
    assert bridge.has_traces(keyed_monkey.data)
    bridge.check_usable(keyed_monkey)
    cubify(bridge, keyed_monkey)


def test_attribute_of_the_artist_with_a_similar_name(bridge, monkey):
    monkey.data.attributes.new("cubic_craft_originality", "FLOAT", "POINT")
    before = snapshot_object(monkey)
    assert not bridge.has_traces(monkey.data)
    cubify(bridge, monkey)
    bridge.restore(monkey)
    assert differences(before, snapshot_object(monkey)) == []


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY"])
def test_traces_come_and_go(bridge, monkey, result):
    assert not bridge.has_traces(monkey.data)
    for remove in (bridge.restore, lambda obj: bridge.discard_original(obj.data)):
        cubify(bridge, monkey, result)
        assert bridge.has_traces(monkey.data)
        remove(monkey)
        assert not bridge.has_traces(monkey.data)


def _move(bridge, obj):
    obj.data.vertices[0].co.x += 1


def _lose_original(bridge, obj):
    obj.data.attributes.remove(obj.data.attributes["cubic_craft_original"])


def _lose_attributes(bridge, obj):
    for name in ("cubic_craft_original", "cubic_craft_rotation"):
        obj.data.attributes.remove(obj.data.attributes[name])


def _lose_marks(bridge, obj):
    for name in ("mark", "written"):
        obj.data.attributes.remove(obj.data.attributes[f"cubic_craft_original.{name}"])
    _move(bridge, obj)


def _lose_key(bridge, obj):
    bridge.restore(obj)
    cubify(bridge, obj, "SHAPE_KEY")
    obj.shape_key_remove(obj.data.shape_keys.key_blocks["Cubic"])


@pytest.mark.parametrize("edit", [_lose_original, _lose_attributes, _lose_marks, _lose_key])
def test_stale(bridge, error, plain_monkey, edit):
    mesh = plain_monkey.data
    cubify(bridge, plain_monkey)
    edit(bridge, plain_monkey)
    before = snapshot_object(plain_monkey)
    shape = position_of(mesh).tobytes()
    assert bridge.has_traces(mesh) and not bridge.has_original(mesh)
    assert bridge.original_positions(mesh).tobytes() == shape
    with pytest.raises(error, match=r'"Suzanne" has been edited since .* now the original: Apply'):
        bridge.restore(plain_monkey)
    assert differences(before, snapshot_object(plain_monkey)) == []
    bridge.discard_original(mesh)
    assert not bridge.has_traces(mesh)
    assert NOTE not in mesh
    assert not [a.name for a in mesh.attributes if a.name.startswith("cubic_craft")]
    assert position_of(mesh).tobytes() == shape


def test_forget_an_edited_key_keeps_it(bridge, keyed_monkey):
    mesh = keyed_monkey.data
    cubify(bridge, keyed_monkey, "SHAPE_KEY")
    mesh.shape_keys.key_blocks["Cubic"].points[3].co.x += 1
    points = points_of(mesh, "Cubic")
    bridge.discard_original(mesh)
    assert not bridge.has_traces(mesh)
    assert np.array_equal(points_of(mesh, "Cubic"), points)
