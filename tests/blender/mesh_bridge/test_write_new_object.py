# SPDX-License-Identifier: GPL-3.0-or-later
import bpy
import pytest
from results import COPIED
from rich_mesh import cubic_like
from snapshot import (
    POSITIONS,
    SHAPE_KEY_POINTS,
    STORED,
    differences,
    snapshot_mesh,
    snapshot_object,
    unchanged,
)


def counts():
    return [
        len(blocks)
        for blocks in (bpy.data.objects, bpy.data.meshes, bpy.data.shape_keys, bpy.data.actions)
    ]


def test_copy_and_source(bridge, monkey):
    mesh = monkey.data
    before = snapshot_object(monkey)
    positions, rotations = cubic_like(bridge.read_positions(mesh))
    new = bridge.write_new_object(monkey, positions, rotations)
    assert differences(before, snapshot_object(monkey), ignore=["selected"]) == []
    assert (new.name, new.data.name) == ("Suzanne Cubic", "Monkey Cubic")
    ignore = POSITIONS + SHAPE_KEY_POINTS + STORED + COPIED
    assert differences(before, snapshot_object(new), ignore=ignore) == []
    assert bridge.read_positions(new.data)[:-4].tobytes() == positions[:-4].tobytes()
    assert new.select_get() and not monkey.select_get()
    assert bpy.context.view_layer.objects.active == new


@pytest.mark.parametrize("first", ["mesh", "key"])
def test_source_with_a_result_of_ours(bridge, monkey, first):
    """The copy starts from the original; the source keeps its result."""
    base = bridge.read_positions(monkey.data)
    directly = bridge.write_new_object(monkey, *cubic_like(base, 2))
    expected = snapshot_mesh(directly.data)
    if first == "mesh":
        bridge.write_mesh(monkey.data, *cubic_like(base, 1))
    else:
        bridge.write_shape_key(monkey, cubic_like(base, 1)[0])
    with unchanged(monkey, ["selected"]):
        new = bridge.write_new_object(monkey, *cubic_like(base, 2))
    assert differences(expected, snapshot_mesh(new.data), ignore=COPIED) == []
    assert bridge.original_positions(new.data).tobytes() == base.tobytes()


@pytest.mark.parametrize("place", [0, 2, 5])
def test_active_key_of_a_source_with_our_key(bridge, cubify, keyed_monkey, place):
    """Our key is not in the copy; those behind it move up there, and the active one with them."""
    keys = keyed_monkey.data.shape_keys.key_blocks
    cubify(keyed_monkey, "SHAPE_KEY")
    keyed_monkey.active_shape_key_index = keys.find("Cubic")
    for _ in range(3):
        bpy.ops.object.shape_key_move(type="UP")
    assert keys.find("Cubic") == 2
    keyed_monkey.active_shape_key_index = place
    name = keys[place].name if place != 2 else keys[1].name  # the one before ours instead of ours
    new = cubify(keyed_monkey, "NEW_OBJECT")
    assert "Cubic" not in new.data.shape_keys.key_blocks
    assert new.active_shape_key.name == name


@pytest.mark.parametrize("painted", ["source", "another"])
def test_mode_other_than_object_mode(bridge, cubify, plain_monkey, painted):
    """An object can leave its mode only while it is active: so it stays that."""
    source = plain_monkey
    if painted == "another":
        bpy.ops.object.select_all(action="DESELECT")
        bpy.ops.mesh.primitive_cube_add()
    active = bpy.context.object
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    selected = source.select_get()
    new = cubify(source, "NEW_OBJECT")
    assert list(new.users_collection) == list(source.users_collection)
    assert bpy.context.view_layer.objects.active == active
    assert (source.select_get(), new.select_get()) == (selected, False)
    assert (active.mode, new.mode) == ("WEIGHT_PAINT", "OBJECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert active.mode == "OBJECT"


def test_object_of_another_scene(bridge, cubify, plain_monkey):
    """It is in no view layer at hand: the copy is made, and nothing is selected."""
    other = bpy.data.scenes.new("Other")
    other.collection.objects.link(plain_monkey)
    bpy.context.scene.collection.objects.unlink(plain_monkey)
    new = cubify(plain_monkey, "NEW_OBJECT")
    assert list(new.users_collection) == [other.collection]
    assert bpy.context.view_layer.objects.active != new
