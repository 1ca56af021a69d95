# SPDX-License-Identifier: GPL-3.0-or-later
"""Results written to the mesh, to a shape key and to a new object: nothing else changes."""

import bpy
import numpy as np
import pytest
from results import COPIED
from rich_mesh import cubic_like, points_of, position_of, set_position
from snapshot import (
    POSITIONS,
    SHAPE_KEY_POINTS,
    STORED,
    differences,
    snapshot_mesh,
    snapshot_object,
    unchanged,
)

LOOSE = slice(-4, None)  # what the rich monkey has in no face
CHANGED = POSITIONS + SHAPE_KEY_POINTS + STORED


def test_only_positions_change(bridge, monkey):
    mesh = monkey.data
    with unchanged(monkey, CHANGED):
        base = bridge.read_positions(mesh)
        positions, rotations = cubic_like(base)
        bridge.write_mesh(mesh, positions, rotations)
    expected = np.vstack((positions[:-4], base[LOOSE]))
    assert bridge.read_positions(mesh).tobytes() == expected.tobytes()
    assert position_of(mesh).tobytes() == expected.tobytes()
    assert bridge.has_original(mesh)
    assert bridge.original_positions(mesh).tobytes() == base.tobytes()


def test_blender_notices(bridge, monkey):
    """The viewport, selection and ray casts use cached bounds, normals and triangles."""
    mesh = monkey.data
    monkey.modifiers.clear()
    if mesh.shape_keys:
        for key in mesh.shape_keys.key_blocks[1:]:
            key.driver_remove("value")
            key.mute = True
    graph = bpy.context.evaluated_depsgraph_get()
    assert monkey.evaluated_get(graph).bound_box is not None
    normal = mesh.vertices[0].normal.copy()
    mesh.calc_loop_triangles()
    bridge.write_mesh(mesh, *cubic_like(4 * bridge.read_positions(mesh)))
    written = bridge.read_positions(mesh)
    graph = bpy.context.evaluated_depsgraph_get()
    evaluated = monkey.evaluated_get(graph)
    assert np.array_equal(position_of(evaluated.data), written)
    for obj in (monkey, evaluated):
        assert np.array_equal(np.max(obj.bound_box, axis=0), written.max(axis=0))
    assert mesh.vertices[0].normal != normal
    fresh = mesh.copy()
    set_position(fresh, written)
    fresh.vertices[0].co = fresh.vertices[0].co
    for copy in (mesh, fresh):
        copy.calc_loop_triangles()
    assert [t.vertices[:] for t in mesh.loop_triangles] == [
        t.vertices[:] for t in fresh.loop_triangles
    ]


@pytest.mark.parametrize("active", [0, 1])
def test_edit_mode_and_back_changes_nothing(bridge, cubify, monkey, active):
    mesh = monkey.data
    monkey.active_shape_key_index = active
    _toggle_edit_mode()  # Blender itself turns -0 into 0 in shape keys at the first time
    before = _shapes(mesh)
    cubify(monkey)
    written = _shapes(mesh)
    _toggle_edit_mode()
    assert _shapes(mesh) == written
    assert bridge.has_original(mesh)
    bridge.restore(monkey)
    assert _shapes(mesh) == before


def _shapes(mesh):
    keys = mesh.shape_keys.key_blocks if mesh.shape_keys else []
    return [position_of(mesh).tobytes()] + [points_of(mesh, key.name).tobytes() for key in keys]


def _toggle_edit_mode():
    for mode in ("EDIT", "OBJECT"):
        bpy.ops.object.mode_set(mode=mode)


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
