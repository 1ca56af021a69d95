# SPDX-License-Identifier: GPL-3.0-or-later
import bpy
import pytest
from rich_mesh import cubic_like, points_of
from snapshot import POSITIONS, SHAPE_KEY_POINTS, STORED, differences, snapshot_object


def test_original_bits_come_back(bridge, monkey):
    before = snapshot_object(monkey)
    mesh = monkey.data
    for seed in (1, 2, 3):
        bridge.write_mesh(mesh, *cubic_like(bridge.original_positions(mesh), seed))
    bridge.restore(monkey)
    assert differences(before, snapshot_object(monkey)) == []
    assert not bridge.has_original(mesh)


def test_copy_of_a_cubified_object_can_be_restored(bridge, monkey):
    base = bridge.read_positions(monkey.data)
    bridge.write_mesh(monkey.data, *cubic_like(base))
    copy = monkey.copy()
    copy.data = monkey.data.copy()
    bridge.restore(copy)
    assert bridge.read_positions(copy.data).tobytes() == base.tobytes()
    assert bridge.has_original(monkey.data)


def test_nothing_to_restore(bridge, error, monkey):
    before = snapshot_object(monkey)
    with pytest.raises(error, match=f'"{monkey.name}".*cubify it first'):
        bridge.restore(monkey)
    assert differences(before, snapshot_object(monkey)) == []


def test_restore_of_no_mesh(bridge, error):
    empty = bpy.data.objects.new("Hook", None)
    with pytest.raises(error, match='"Hook" is not a mesh'):
        bridge.restore(empty)


@pytest.mark.parametrize(
    "failing", ["result.restore.drop_stored", "result.restore.remove_cubic_key"]
)
@pytest.mark.parametrize("first", ["mesh", "key"])
def test_failure_half_way_changes_nothing(bridge, monkey, failing, first, fail_once):
    positions, rotations = cubic_like(bridge.read_positions(monkey.data))
    if first == "mesh":
        bridge.write_mesh(monkey.data, positions, rotations)
    else:
        bridge.write_shape_key(monkey, positions)
    before = snapshot_object(monkey)
    fail_once(failing, call=1)
    with pytest.raises(RuntimeError, match="disk on fire"):
        bridge.restore(monkey)
    assert differences(before, snapshot_object(monkey)) == []
    bridge.restore(monkey)


def test_forget_keeps_the_shape(bridge, error, monkey):
    mesh = monkey.data
    before = snapshot_object(monkey)
    bridge.write_mesh(mesh, *cubic_like(bridge.read_positions(mesh)))
    written = snapshot_object(monkey)
    bridge.discard_original(mesh)
    after = snapshot_object(monkey)
    assert differences(before, after, ignore=POSITIONS + SHAPE_KEY_POINTS) == []
    assert differences(written, after, ignore=STORED) == []
    assert not bridge.has_original(mesh)
    with pytest.raises(error):
        bridge.restore(monkey)


def test_forget_keeps_the_shape_key(bridge, monkey):
    mesh = monkey.data
    bridge.write_shape_key(monkey, cubic_like(bridge.read_positions(mesh))[0])
    written = snapshot_object(monkey)
    points = points_of(mesh, "Cubic")
    bridge.discard_original(mesh)
    assert differences(written, snapshot_object(monkey), ignore=STORED) == []
    bridge.write_shape_key(monkey, cubic_like(bridge.read_positions(mesh), 1)[0])
    assert points_of(mesh, "Cubic").tobytes() == points.tobytes()
    assert "Cubic.001" in mesh.shape_keys.key_blocks


def test_forget_nothing(bridge, monkey):
    before = snapshot_object(monkey)
    bridge.discard_original(monkey.data)
    assert differences(before, snapshot_object(monkey)) == []


def test_forget_a_stale_original(bridge, plain_monkey):
    mesh = plain_monkey.data
    bridge.write_mesh(mesh, *cubic_like(bridge.read_positions(mesh)))
    mesh.vertices[0].co.x += 1
    bridge.discard_original(mesh)
    assert not any(a.name.startswith("cubic_craft") for a in mesh.attributes)
    assert "cubic_craft_note" not in mesh
