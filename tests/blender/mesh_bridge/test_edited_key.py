# SPDX-License-Identifier: GPL-3.0-or-later
"""Whose a shape key is: ours only as we wrote it, or as Blender moved it along with Basis."""

import numpy as np
import pytest
from rich_mesh import cubic_like, points_of
from scene import edit_mode
from snapshot import STORED, differences, snapshot_object


def edit_by_hand(obj, name, change=0.25):
    """Move a vertex of a shape key in Edit Mode."""
    obj.active_shape_key_index = obj.data.shape_keys.key_blocks.find(name)
    with edit_mode(obj) as bm:
        bm.verts[20].co.y += change


def test_new_key_of_the_artist_under_the_same_name(bridge, cubify, error, keyed_monkey):
    mesh = keyed_monkey.data
    cubify(keyed_monkey, "SHAPE_KEY")
    keyed_monkey.shape_key_remove(mesh.shape_keys.key_blocks["Cubic"])
    keyed_monkey.shape_key_add(name="Cubic", from_mix=False)
    before = snapshot_object(keyed_monkey)
    assert not bridge.has_original(mesh)
    with pytest.raises(error, match="edited since"):
        bridge.restore(keyed_monkey)
    assert differences(before, snapshot_object(keyed_monkey)) == []
    cubify(keyed_monkey, "SHAPE_KEY")
    bridge.restore(keyed_monkey)
    assert differences(before, snapshot_object(keyed_monkey), ignore=STORED) == []
    assert not bridge.has_traces(mesh)


@pytest.mark.parametrize("change", [0.25, 1e-6])
def test_key_edited_by_hand_is_left_for_a_new_one(bridge, cubify, monkey, change):
    mesh = monkey.data
    cubify(monkey, "SHAPE_KEY", seed=1)
    edit_by_hand(monkey, "Cubic", change)
    points = points_of(mesh, "Cubic")
    assert not bridge.has_original(mesh)
    count = len(mesh.shape_keys.key_blocks)
    for seed in (2, 3):
        cubify(monkey, "SHAPE_KEY", seed=seed)
        positions, _ = cubic_like(bridge.read_positions(mesh), seed)
        assert points_of(mesh, "Cubic").tobytes() == points.tobytes()
        assert points_of(mesh, "Cubic.001")[:-4].tobytes() == positions[:-4].tobytes()
        assert len(mesh.shape_keys.key_blocks) == count + 1
    bridge.restore(monkey)
    assert points_of(mesh, "Cubic").tobytes() == points.tobytes()
    assert len(mesh.shape_keys.key_blocks) == count


def test_key_edited_by_hand_is_carried_like_any_other(bridge, cubify, monkey):
    mesh = monkey.data
    cubify(monkey, "SHAPE_KEY", seed=1)
    edit_by_hand(monkey, "Cubic")
    points = points_of(mesh, "Cubic")
    cubify(monkey, "MESH", seed=2)
    assert "Cubic" in mesh.shape_keys.key_blocks
    bridge.restore(monkey)
    assert points_of(mesh, "Cubic").tobytes() == points.tobytes()
    assert not bridge.has_traces(mesh)


def test_basis_edited_under_our_key(bridge, cubify, monkey):
    """Again and again, here by numbers that round, and with our key under another name."""
    mesh = monkey.data
    cubify(monkey, "SHAPE_KEY", seed=1)
    basis = mesh.shape_keys.reference_key.name
    mesh.shape_keys.key_blocks["Cubic"].name = "Blocky"
    points = points_of(mesh, "Blocky")
    count = len(mesh.shape_keys.key_blocks)
    monkey.active_shape_key_index = 0
    for angle in (0.1, -0.7, 1.3):
        cos, sin = np.cos(angle), np.sin(angle)
        with edit_mode(monkey) as bm:
            for vertex in bm.verts:
                x, y, z = vertex.co
                vertex.co = (cos * x - sin * y + angle, sin * x + cos * y, z / 3)
    assert np.abs(points_of(mesh, "Blocky") - points).max() > 0.5
    edited = points_of(mesh, basis)
    assert bridge.has_original(mesh)
    cubify(monkey, "SHAPE_KEY", seed=2)
    assert len(mesh.shape_keys.key_blocks) == count
    edit_by_hand(monkey, basis)
    cubify(monkey, "MESH")
    assert "Blocky" not in (mesh.shape_keys.key_blocks if mesh.shape_keys else ())
    bridge.restore(monkey)
    edited[20, 1] += 0.25
    assert bridge.read_positions(mesh).tobytes() == edited.tobytes()


def test_edit_mode_and_back_leaves_our_key_ours(bridge, cubify, monkey):
    """Blender turns -0 into 0 there, in the key and in Basis."""
    mesh = monkey.data
    positions, _ = cubic_like(bridge.read_positions(mesh))
    positions[::2, 0] = -0.0
    bridge.write_shape_key(monkey, positions)
    for index in (0, mesh.shape_keys.key_blocks.find("Cubic")):
        monkey.active_shape_key_index = index
        with edit_mode(monkey):
            pass
        assert bridge.has_original(mesh)
    assert not np.signbit(points_of(mesh, "Cubic")[::2, 0][:-4]).any()
    bridge.restore(monkey)
    assert not bridge.has_traces(mesh)


def test_unedited_key_of_the_artist_is_never_ours(bridge, cubify, keyed_monkey):
    """Also where our result was equal to Basis, as each new key of the artist is at first."""
    mesh = keyed_monkey.data
    bridge.write_shape_key(keyed_monkey, bridge.read_positions(mesh))
    keyed_monkey.shape_key_remove(mesh.shape_keys.key_blocks["Cubic"])
    keyed_monkey.shape_key_add(name="Blink", from_mix=False)
    assert not bridge.has_original(mesh)
    keyed_monkey.active_shape_key_index = 0
    edit_by_hand(keyed_monkey, "Basis")
    assert not bridge.has_original(mesh)
    cubify(keyed_monkey, "SHAPE_KEY")
    bridge.restore(keyed_monkey)
    assert "Blink" in mesh.shape_keys.key_blocks
