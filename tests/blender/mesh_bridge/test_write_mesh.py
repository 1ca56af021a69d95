# SPDX-License-Identifier: GPL-3.0-or-later

import bpy
import numpy as np
import pytest
from rich_mesh import cubic_like, points_of, position_of, set_points, set_position
from snapshot import POSITIONS, SHAPE_KEY_POINTS, STORED, differences, snapshot_object

LOOSE = slice(-4, None)  # what the rich monkey has in no face
CHANGED = POSITIONS + SHAPE_KEY_POINTS + STORED


def test_only_positions_change(bridge, monkey):
    mesh = monkey.data
    before = snapshot_object(monkey)
    base = bridge.read_positions(mesh)
    positions, rotations = cubic_like(base)
    bridge.write_mesh(mesh, positions, rotations)
    assert differences(before, snapshot_object(monkey), ignore=CHANGED) == []
    expected = np.vstack((positions[:-4], base[LOOSE]))
    assert bridge.read_positions(mesh).tobytes() == expected.tobytes()
    assert position_of(mesh).tobytes() == expected.tobytes()


def test_stored_original(bridge, monkey):
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    assert not bridge.has_original(mesh)
    bridge.write_mesh(mesh, *cubic_like(base))
    assert bridge.has_original(mesh)
    assert bridge.original_positions(mesh).tobytes() == base.tobytes()
    flat = np.empty(base.size, np.float32)
    mesh.attributes["cubic_craft_original"].data.foreach_get("vector", flat)
    assert flat.tobytes() == base.tobytes()


def test_other_attributes_keep_their_order_and_active_one(bridge, monkey):
    mesh = monkey.data
    for place in range(len(mesh.attributes)):
        mesh.attributes.active_index = place
        before = snapshot_object(monkey)
        names = [a.name for a in mesh.attributes]
        bridge.write_mesh(mesh, *cubic_like(bridge.original_positions(mesh)))
        assert mesh.attributes[mesh.attributes.active_index].name == names[place]
        kept = [a.name for a in mesh.attributes if not a.name.startswith("cubic_craft")]
        assert kept == names
        bridge.restore(monkey)
        assert differences(before, snapshot_object(monkey)) == []


def test_twice_is_once(bridge, monkey):
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    bridge.write_mesh(mesh, *cubic_like(base, 1))
    once = snapshot_object(monkey)
    bridge.write_mesh(mesh, *cubic_like(bridge.original_positions(mesh), 2))
    assert differences(once, snapshot_object(monkey)) != []
    bridge.write_mesh(mesh, *cubic_like(bridge.original_positions(mesh), 1))
    assert differences(once, snapshot_object(monkey)) == []


def test_result_equal_to_base_changes_no_bit(bridge, monkey):
    """Also zeros of either sign and tiny numbers, which arithmetic would lose."""
    mesh = monkey.data
    before = snapshot_object(monkey)
    positions = bridge.read_positions(mesh)
    unturned = np.broadcast_to(np.eye(3), (len(positions), 3, 3))
    bridge.write_mesh(mesh, positions + 0.0, unturned)
    assert differences(before, snapshot_object(monkey), ignore=STORED) == []


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


def test_mesh_of_two_objects(bridge, monkey):
    twin = bpy.data.objects.new("Twin", monkey.data)
    bpy.context.collection.objects.link(twin)
    twin.active_shape_key_index = 1 if monkey.data.shape_keys else 0
    before = snapshot_object(twin)
    bridge.write_mesh(monkey.data, *cubic_like(bridge.read_positions(monkey.data)))
    assert twin.data == monkey.data
    assert differences(before, snapshot_object(twin), ignore=CHANGED) == []
    bridge.restore(twin)
    assert differences(before, snapshot_object(twin)) == []


@pytest.mark.parametrize("active", [0, 1])
def test_edit_mode_and_back_changes_nothing(bridge, monkey, active):
    mesh = monkey.data
    monkey.active_shape_key_index = active
    _toggle_edit_mode()  # Blender itself turns -0 into 0 in shape keys at the first time
    before = _shapes(mesh)
    bridge.write_mesh(mesh, *cubic_like(bridge.read_positions(mesh)))
    written = _shapes(mesh)
    _toggle_edit_mode()
    assert _shapes(mesh) == written
    assert bridge.has_original(mesh)
    bridge.restore(monkey)
    assert _shapes(mesh) == before


def test_save_and_load(bridge, monkey, tmp_path):
    before = snapshot_object(monkey)
    name = monkey.name
    bridge.write_mesh(monkey.data, *cubic_like(bridge.read_positions(monkey.data)))
    written = snapshot_object(monkey)
    path = str(tmp_path / "monkey.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    loaded = bpy.data.objects[name]
    assert differences(written, snapshot_object(loaded)) == []
    bridge.restore(loaded)
    assert differences(before, snapshot_object(loaded)) == []


def test_deleted_attribute_makes_it_the_original(bridge, plain_monkey):
    mesh = plain_monkey.data
    bridge.write_mesh(mesh, *cubic_like(bridge.read_positions(mesh)))
    mesh.attributes.remove(mesh.attributes["cubic_craft_original"])
    assert not bridge.has_original(mesh)
    bridge.write_mesh(mesh, *cubic_like(bridge.read_positions(mesh)))
    assert bridge.has_original(mesh)


@pytest.mark.parametrize(
    "broken", ["positions", "rotations", "few positions", "few rotations", "huge"]
)
def test_refused_results_change_nothing(bridge, error, monkey, broken):
    mesh = monkey.data
    before = snapshot_object(monkey)
    positions, rotations = cubic_like(bridge.read_positions(mesh))
    if broken == "positions":
        positions[5, 1] = np.nan
    elif broken == "rotations":
        rotations[7, 0, 0] = np.inf
    elif broken == "few positions":
        positions = positions[:-1]
    elif broken == "few rotations":
        rotations = rotations[:-1]
    else:
        positions = positions.astype(np.float64)
        positions[0] = 1e39
    with pytest.raises(error, match=mesh.name):
        bridge.write_mesh(mesh, positions, rotations)
    assert differences(before, snapshot_object(monkey)) == []


def test_carried_keys_must_stay_finite(bridge, error, keyed_monkey):
    mesh = keyed_monkey.data
    points = points_of(mesh, "Wide")
    points[3] = 3e38
    set_points(mesh, "Wide", points)
    before = snapshot_object(keyed_monkey)
    positions, rotations = cubic_like(bridge.read_positions(mesh))
    rotations[3] = [[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]]
    with pytest.raises(error, match="Wide"):
        bridge.write_mesh(mesh, positions, rotations)
    assert differences(before, snapshot_object(keyed_monkey)) == []


@pytest.mark.parametrize("first", [None, "mesh", "key"])
@pytest.mark.parametrize(
    "failing",
    [
        "memory.original.add_attribute",
        "memory.original.write_note",
        "access.shapes.write_position",
        "access.shapes.mark_moved",
    ],
)
def test_failure_half_way_changes_nothing(bridge, monkey, failing, first, fail_once):
    mesh = monkey.data
    result = cubic_like(bridge.read_positions(mesh))
    if first == "mesh":
        bridge.write_mesh(mesh, *result)
    elif first == "key":
        bridge.write_shape_key(monkey, result[0])
    before = snapshot_object(monkey)
    fail_once(failing, call=2 if failing.startswith("memory.original") else 1)
    with pytest.raises(RuntimeError, match="disk on fire"):
        bridge.write_mesh(mesh, *cubic_like(bridge.original_positions(mesh), 2))
    assert differences(before, snapshot_object(monkey)) == []


def _shapes(mesh):
    keys = mesh.shape_keys.key_blocks if mesh.shape_keys else []
    return [position_of(mesh).tobytes()] + [points_of(mesh, key.name).tobytes() for key in keys]


def _toggle_edit_mode():
    for mode in ("EDIT", "OBJECT"):
        bpy.ops.object.mode_set(mode=mode)


def _move_one(mesh):
    if mesh.shape_keys is None:
        positions = position_of(mesh)
        positions[17, 2] = np.nextafter(positions[17, 2], np.float32(9))
        set_position(mesh, positions)
    else:
        points = points_of(mesh, "Basis")
        points[17, 2] = np.nextafter(points[17, 2], np.float32(9))
        set_points(mesh, "Basis", points)
        set_position(mesh, points)
