# SPDX-License-Identifier: GPL-3.0-or-later
"""Shape keys under a result written to the mesh: carried along, and back."""

import numpy as np
import pytest
from rich_mesh import cubic_like, points_of, position_of, set_points, set_position
from snapshot import differences, snapshot_object

OTHERS = {"Smile": "Frown", "Frown": "Basis", "Wide": "Basis"}


def test_offsets_turn_with_their_vertices(bridge, keyed_monkey):
    mesh = keyed_monkey.data
    before = {name: points_of(mesh, name) for name in ("Basis", *OTHERS)}
    positions, rotations = cubic_like(before["Basis"])
    bridge.write_mesh(mesh, positions, rotations)
    for name, other in OTHERS.items():
        offset = (before[name] - before[other])[:-4, :, None]
        turned = (rotations[:-4] @ offset)[:, :, 0]
        carried = (points_of(mesh, name) - points_of(mesh, other))[:-4]
        assert np.abs(turned).max() > 0.1
        np.testing.assert_allclose(carried, turned, atol=1e-6)


def test_loose_vertices_keep_their_keys(bridge, cubify, keyed_monkey):
    mesh = keyed_monkey.data
    points = points_of(mesh, "Wide")
    points[-4:] += 0.3
    set_points(mesh, "Wide", points)
    cubify(keyed_monkey)
    assert points_of(mesh, "Wide")[-4:].tobytes() == points[-4:].tobytes()


@pytest.mark.parametrize("circle", [{"Wide": "Wide"}, {"Smile": "Frown", "Frown": "Smile"}])
def test_keys_in_a_circle_keep_their_offset_from_the_base(bridge, keyed_monkey, circle):
    mesh = keyed_monkey.data
    keys = mesh.shape_keys.key_blocks
    for name, other in circle.items():
        keys[name].relative_key = keys[other]
    before = snapshot_object(keyed_monkey)
    base = bridge.read_positions(mesh)
    first = next(iter(circle))
    offset = points_of(mesh, first) - base
    positions, rotations = cubic_like(base)
    bridge.write_mesh(mesh, positions, rotations)
    carried = points_of(mesh, first)[:-4] - positions[:-4]
    np.testing.assert_allclose(carried, np.einsum("nij,nj->ni", rotations, offset)[:-4], atol=1e-6)
    bridge.restore(keyed_monkey)
    assert differences(before, snapshot_object(keyed_monkey)) == []


def test_position_unequal_to_basis_is_restored(bridge, cubify, keyed_monkey):
    """A script may leave them unequal; while ours is on the mesh both are the cubic shape."""
    mesh = keyed_monkey.data
    set_position(mesh, position_of(mesh) * 2)
    before = snapshot_object(keyed_monkey)
    base = points_of(mesh, "Basis")
    assert bridge.read_positions(mesh).tobytes() == base.tobytes()
    for seed in (1, 2):
        cubify(keyed_monkey, seed=seed)
        assert bridge.original_positions(mesh).tobytes() == base.tobytes()
        assert position_of(mesh).tobytes() == points_of(mesh, "Basis").tobytes()
    bridge.restore(keyed_monkey)
    assert differences(before, snapshot_object(keyed_monkey)) == []


def test_renamed_key_is_restored_exactly(bridge, cubify, keyed_monkey):
    mesh = keyed_monkey.data
    before = points_of(mesh, "Smile")
    cubify(keyed_monkey)
    mesh.shape_keys.key_blocks["Smile"].name = "Grin"
    cubify(keyed_monkey, seed=1)
    bridge.restore(keyed_monkey)
    assert points_of(mesh, "Grin").tobytes() == before.tobytes()


@pytest.mark.parametrize("edited", ["Wide", "Frown", "Smile"])
def test_edit_of_a_key_survives(bridge, keyed_monkey, edited):
    """It is turned back with the others and comes out the same under the next result."""
    mesh = keyed_monkey.data
    base = bridge.read_positions(mesh)
    before = {name: points_of(mesh, name) for name in OTHERS}
    positions, rotations = cubic_like(base)
    bridge.write_mesh(mesh, positions, rotations)
    points = points_of(mesh, edited)
    points[40:60] += (0.1, -0.2, 0.3)
    set_points(mesh, edited, points)
    others = {name: points_of(mesh, name) for name in OTHERS}
    bridge.write_mesh(mesh, positions, rotations)
    for name, values in others.items():
        np.testing.assert_allclose(points_of(mesh, name), values, atol=2e-6)
    bridge.restore(keyed_monkey)
    for name in set(OTHERS) - {edited}:
        assert points_of(mesh, name).tobytes() == before[name].tobytes()
    change = points_of(mesh, edited) - before[edited]
    back = rotations.transpose(0, 2, 1) @ np.array((0.1, -0.2, 0.3))
    np.testing.assert_allclose(change[40:60], back[40:60], atol=2e-6)
    np.testing.assert_allclose(np.delete(change, slice(40, 60), axis=0), 0, atol=2e-6)
    assert bridge.read_positions(mesh).tobytes() == base.tobytes()


@pytest.mark.parametrize("relative_to", ["Basis", "Smile"])
def test_key_added_to_the_cubic_shape_is_carried_back(bridge, monkey, relative_to):
    """Also where the mesh had no shape keys when it was cubified."""
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    positions, rotations = cubic_like(base)
    bridge.write_mesh(mesh, positions, rotations)
    if mesh.shape_keys is None:
        monkey.shape_key_add(name="Basis", from_mix=False)
    other = relative_to if relative_to in mesh.shape_keys.key_blocks else "Basis"
    key = monkey.shape_key_add(name="New", from_mix=False)
    key.relative_key = mesh.shape_keys.key_blocks[other]
    points = points_of(mesh, other)
    points[30] += (0, 0, 0.5)
    set_points(mesh, "New", points)
    assert bridge.has_original(mesh)
    bridge.restore(monkey)
    assert bridge.read_positions(mesh).tobytes() == base.tobytes()
    assert position_of(mesh).tobytes() == base.tobytes()
    expected = points_of(mesh, other)
    np.testing.assert_array_equal(
        np.delete(points_of(mesh, "New"), 30, 0), np.delete(expected, 30, 0)
    )
    back = points_of(mesh, "New")[30] - expected[30]
    np.testing.assert_allclose(back, rotations[30].T @ (0, 0, 0.5), atol=1e-6)


def test_another_reference_key_makes_it_the_original(bridge, cubify, keyed_monkey):
    mesh = keyed_monkey.data
    cubify(keyed_monkey)
    keyed_monkey.shape_key_remove(mesh.shape_keys.reference_key)
    assert mesh.shape_keys.reference_key.name == "Smile"
    assert not bridge.has_original(mesh)
    assert bridge.original_positions(mesh).tobytes() == points_of(mesh, "Smile").tobytes()
    cubify(keyed_monkey)
    assert bridge.has_original(mesh)
