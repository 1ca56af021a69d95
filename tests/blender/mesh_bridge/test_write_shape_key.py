# SPDX-License-Identifier: GPL-3.0-or-later
import bpy
import numpy as np
import pytest
from rich_mesh import cubic_like, points_of, position_of
from snapshot import STORED, differences, snapshot_object, unchanged

# Our key in a snapshot, and that there are keys at all.
OUR_KEY = (*STORED, "*shape_keys/blocks/Cubic/*", "*shape_keys/order")
NEW_KEYS = (*OUR_KEY, "*shape_keys/*", "*rna/shape_keys", "*rna/active_shape_key")


def result_of(bridge, mesh, seed=0):
    return cubic_like(bridge.original_positions(mesh), seed)


def test_nothing_else_changes(bridge, monkey):
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    positions, _ = cubic_like(base)
    ignore = OUR_KEY if mesh.shape_keys else NEW_KEYS
    with unchanged(monkey, (*ignore, "*rna/dimensions")):  # the evaluated shape is the key's now
        bridge.write_shape_key(monkey, positions)
    key = mesh.shape_keys.key_blocks["Cubic"]
    assert (key.value, key.mute, key.slider_min, key.slider_max) == (1.0, False, 0.0, 1.0)
    assert key.relative_key == mesh.shape_keys.reference_key
    expected = np.vstack((positions[:-4], base[-4:]))
    assert points_of(mesh, "Cubic").tobytes() == expected.tobytes()
    assert bridge.read_positions(mesh).tobytes() == base.tobytes()
    assert bridge.original_positions(mesh).tobytes() == base.tobytes()
    assert bridge.has_original(mesh)
    ours = {a.name for a in mesh.attributes if a.name.startswith("cubic_craft")}
    assert ours == {"cubic_craft_key", "cubic_craft_key.base"}


def test_evaluated_shape(bridge, plain_monkey):
    plain_monkey.modifiers.clear()
    positions = 3 * cubic_like(bridge.read_positions(plain_monkey.data))[0]
    bridge.write_shape_key(plain_monkey, positions)
    for value in (1.0, 0.5):
        key = plain_monkey.data.shape_keys.key_blocks["Cubic"]
        key.value = value
        graph = bpy.context.evaluated_depsgraph_get()
        evaluated = plain_monkey.evaluated_get(graph)
        base = bridge.read_positions(plain_monkey.data)
        expected = base + value * (points_of(plain_monkey.data, "Cubic") - base)
        np.testing.assert_allclose(position_of(evaluated.data), expected, atol=1e-6)
        np.testing.assert_allclose(
            np.max(evaluated.bound_box, axis=0), expected.max(axis=0), atol=1e-6
        )
    plain_monkey.data.shape_keys.key_blocks["Cubic"].value = 1
    graph = bpy.context.evaluated_depsgraph_get()
    bridge.write_shape_key(plain_monkey, 2 * positions)
    graph = bpy.context.evaluated_depsgraph_get()
    evaluated = position_of(plain_monkey.evaluated_get(graph).data)
    np.testing.assert_allclose(evaluated[:-4], 2 * positions[:-4], atol=1e-5)


def test_again_keeps_what_the_artist_did_with_the_key(bridge, cubify, monkey):
    mesh = monkey.data
    cubify(monkey, "SHAPE_KEY", seed=1)
    key = mesh.shape_keys.key_blocks["Cubic"]
    key.slider_max = 2.0
    key.value = 0.25
    key.mute = True
    key.vertex_group = "Map"
    key.driver_add("slider_min").driver.expression = "0.125"
    points = points_of(mesh, "Cubic")
    before = snapshot_object(monkey)
    cubify(monkey, "SHAPE_KEY", seed=2)
    points_only = ("*shape_keys/blocks/Cubic/points", *STORED)
    assert differences(before, snapshot_object(monkey), ignore=points_only) == []
    assert points_of(mesh, "Cubic").tobytes() != points.tobytes()
    cubify(monkey, "SHAPE_KEY", seed=1)
    assert differences(before, snapshot_object(monkey)) == []


def test_key_of_the_artist_called_cubic_is_not_ours(bridge, keyed_monkey):
    mesh = keyed_monkey.data
    keyed_monkey.shape_key_add(name="Cubic", from_mix=False).value = 0.5
    before = snapshot_object(keyed_monkey)
    for seed in (1, 2):
        positions, _ = result_of(bridge, mesh, seed)
        bridge.write_shape_key(keyed_monkey, positions)
        ours = mesh.shape_keys.key_blocks["Cubic.001"]
        assert points_of(mesh, ours.name)[:-4].tobytes() == positions[:-4].tobytes()
    ignore = (*OUR_KEY, "*shape_keys/blocks/Cubic.001/*", "*rna/dimensions")
    ignore = tuple(path for path in ignore if path != "*shape_keys/blocks/Cubic/*")
    assert differences(before, snapshot_object(keyed_monkey), ignore=ignore) == []
    bridge.restore(keyed_monkey)
    assert differences(before, snapshot_object(keyed_monkey)) == []


def test_basis_of_ours_stays_while_another_key_needs_it(bridge, cubify, plain_monkey):
    mesh = plain_monkey.data
    cubify(plain_monkey, "SHAPE_KEY")
    plain_monkey.shape_key_add(name="Smile", from_mix=False)
    bridge.restore(plain_monkey)
    assert [key.name for key in mesh.shape_keys.key_blocks] == ["Basis", "Smile"]


def test_active_key_of_every_user(bridge, cubify, keyed_monkey):
    """Also where our key is not the last one any more when it goes."""
    mesh = keyed_monkey.data
    twins = [
        bpy.data.objects.new(f"Twin {i}", mesh) for i in range(len(mesh.shape_keys.key_blocks))
    ]
    for index, twin in enumerate(twins):
        twin.active_shape_key_index = index
    names = [twin.active_shape_key.name for twin in twins]
    cubify(keyed_monkey, "SHAPE_KEY")
    assert [twin.active_shape_key.name for twin in twins] == names
    keyed_monkey.active_shape_key_index = mesh.shape_keys.key_blocks.find("Cubic")
    bpy.ops.object.shape_key_move(type="UP")
    for twin, name in zip(twins, names, strict=True):
        twin.active_shape_key_index = mesh.shape_keys.key_blocks.find(name)
    bridge.restore(keyed_monkey)
    assert [twin.active_shape_key.name for twin in twins] == names
    assert keyed_monkey.active_shape_key.name == "Wide"  # the one before ours


def test_drivers_of_the_key_go_with_it(bridge, cubify, keyed_monkey):
    mesh = keyed_monkey.data
    drivers = [curve.data_path for curve in mesh.shape_keys.animation_data.drivers]
    cubify(keyed_monkey, "SHAPE_KEY")
    mesh.shape_keys.key_blocks["Cubic"].driver_add("value")
    mesh.shape_keys.key_blocks["Cubic"].driver_add("mute")
    bridge.restore(keyed_monkey)
    assert [curve.data_path for curve in mesh.shape_keys.animation_data.drivers] == drivers


def test_absolute_keys_are_refused(bridge, error, keyed_monkey):
    """Among them "Cubic" would be a pose in time, which its value does not dial."""
    mesh = keyed_monkey.data
    mesh.shape_keys.use_relative = False
    with unchanged(keyed_monkey):
        positions = result_of(bridge, mesh)[0]
        with pytest.raises(error, match=r'"Suzanne" has absolute shape keys.*enable Relative'):
            bridge.write_shape_key(keyed_monkey, positions)
    mesh.shape_keys.use_relative = True
    bridge.write_shape_key(keyed_monkey, positions)
