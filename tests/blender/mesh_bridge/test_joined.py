# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that are joined, multiplied and taken apart: each part keeps its original."""

import bmesh
import bpy
import numpy as np
import pytest
from rich_mesh import add_rich_monkey, points_of, position_of
from scene import add_copy, add_monkey, bmesh_of, select
from snapshot import POSITIONS, SHAPE_KEY_POINTS, STORED, unchanged


def add_cube(**where):
    bpy.ops.mesh.primitive_cube_add(**where)
    return bpy.context.object


def add_sphere():
    bpy.ops.mesh.primitive_uv_sphere_add(
        segments=12, ring_count=6, location=(-3, 2, 1), rotation=(1, 2, 3), scale=(1, 2, 0.5)
    )
    return bpy.context.object


def join(active, *others):
    """Join, and return the matrices that have brought the others into the active one's space."""
    bpy.context.view_layer.update()
    into = active.matrix_world.inverted()
    moves = [np.array(into @ other.matrix_world) for other in others]
    select(active, *others)
    assert bpy.ops.object.join() == {"FINISHED"}
    return moves


def moved(points, matrix):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


@pytest.mark.parametrize("into", ["cubic", "plain"])
def test_with_one_that_was_never_cubified(bridge, cubify, into):
    cube, monkey = add_cube(location=(0, 0, 2)), add_monkey(rotation=(0.3, 0, 1))
    plain, base = position_of(cube.data), position_of(monkey.data)
    cubify(monkey)
    if into == "cubic":
        obj, (matrix,) = monkey, join(monkey, cube)
        expected = np.vstack([base, moved(plain, matrix)])
    else:
        obj, (matrix,) = cube, join(cube, monkey)
        expected = np.vstack([plain, moved(base, matrix)])
    assert not bridge.is_edited(obj.data)
    np.testing.assert_allclose(bridge.original_positions(obj.data), expected, atol=2e-6)
    cubify(obj, seed=1)
    stored = {a.name for a in obj.data.attributes if a.name.startswith("cubic_craft")}
    assert len(stored) == 4
    bridge.restore(obj)
    np.testing.assert_allclose(position_of(obj.data), expected, atol=2e-6)
    assert not bridge.has_traces(obj.data)


@pytest.mark.parametrize("also", ["nothing", "applied", "moved by hand", "deleted"])
def test_copies_of_a_result(bridge, cubify, also):
    """They have the same marks, and are told apart by their order."""
    one = add_monkey(rotation=(0.1, 0.2, 0.3))
    base = position_of(one.data)
    cubify(one)
    copies = []
    for number in (1, 2, 3):
        copy = add_copy(one)
        copy.location, copy.scale = (3 * number, number, 0), (1, -1 / number, 1)
        copies.append(copy)
    matrices = [np.eye(4), *join(one, *copies)]
    mesh, count = one.data, len(base)
    expected = np.vstack([moved(base, matrix) for matrix in matrices])
    # Blender joins in the order of the scene.
    assert len(mesh.vertices) == 4 * count
    if also == "applied":
        bpy.context.view_layer.update()
        one.scale = (2, 2, 2)
        one.rotation_euler = one.location = (0, 0, 0)
        bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
        expected *= 2
    elif also == "moved by hand":
        mesh.vertices[count + 30].co.z += 0.25
        mesh.update()
        assert bridge.is_edited(mesh)
    elif also == "deleted":
        gone = slice(2 * count + 100, 2 * count + 200)
        with bmesh_of(mesh) as bm:
            bmesh.ops.delete(bm, geom=bm.verts[gone], context="VERTS")
        expected = np.delete(expected, gone, axis=0)
    assert bridge.is_edited(mesh) == (also == "moved by hand")
    bridge.restore(one)
    np.testing.assert_allclose(position_of(mesh), expected, atol=1e-5)


@pytest.mark.parametrize("keyed", ["active", "other", "both"])
def test_shape_keys(bridge, cubify, keyed):
    """What of a key can be told exactly is; else it is carried, and nothing is lost."""
    one, other = add_rich_monkey(keys=keyed != "other"), add_rich_monkey(keys=keyed != "active")
    for obj, twist in ((one, 0.0), (other, 0.7)):
        obj.rotation_euler = obj.location = (twist, 0, twist)
        for key in obj.data.shape_keys.key_blocks if obj.data.shape_keys else ():
            # Blender 5.0 never ends joining keys to a mesh without, where they are in a chain.
            key.relative_key = obj.data.shape_keys.reference_key
    expected = {}
    for number, obj in enumerate((one, other)):
        mesh = obj.data
        names = mesh.shape_keys.key_blocks.keys() if mesh.shape_keys else []
        for name in names or ["Basis"]:
            values = points_of(mesh, name) if names else position_of(mesh)
            expected.setdefault(name, {})[number] = values
        cubify(obj, seed=number)
    (matrix,) = join(one, other)
    mesh, count = one.data, len(expected["Basis"][0])
    assert not bridge.is_edited(mesh)
    with unchanged(one, (*POSITIONS, *SHAPE_KEY_POINTS, *STORED)):
        bridge.restore(one)
    for name, parts in expected.items():
        for number, rows in enumerate((slice(0, count), slice(count, None))):
            values = parts.get(number, expected["Basis"][number])
            if number:
                values = moved(values, matrix)
            np.testing.assert_allclose(points_of(mesh, name)[rows], values, atol=3e-6)


def test_taken_apart(bridge, cubify):
    one, other = add_monkey(), add_sphere()
    first = position_of(one.data)
    cubify(one)
    cubify(other)
    join(one, other)
    select(one)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.separate(type="LOOSE")
    bpy.ops.object.mode_set(mode="OBJECT")
    pieces = list(bpy.context.selected_objects)
    assert len(pieces) == 4  # the monkey's eyes are parts of their own
    for piece in pieces:
        assert not bridge.is_edited(piece.data)
        bridge.restore(piece)
    rows = {tuple(point) for piece in pieces for point in position_of(piece.data).tolist()}
    assert rows >= {tuple(point) for point in first.tolist()}


def test_modifiers_that_copy(bridge, cubify):
    obj = add_monkey()
    base = position_of(obj.data)
    cubify(obj)
    mirror = obj.modifiers.new("Mirror", "MIRROR")
    mirror.use_axis = (False, False, True)
    mirror.use_mirror_merge = False
    array = obj.modifiers.new("Array", "ARRAY")
    array.count, array.relative_offset_displace = 3, (0, 2, 0)
    for name in ("Mirror", "Array"):
        bpy.ops.object.modifier_apply(modifier=name)
    mesh, count = obj.data, len(base)
    assert len(mesh.vertices) == 6 * count
    assert bridge.has_original(mesh) and not bridge.is_edited(mesh)
    bridge.restore(obj)
    parts = position_of(mesh).reshape(6, count, 3)
    assert parts[0].tobytes() == base.tobytes()
    assert np.array_equal(parts[1], base * (1, 1, -1))
    for number in (1, 2):
        offset = parts[2 * number] - parts[0]
        np.testing.assert_allclose(offset, np.broadcast_to(offset[:1], offset.shape), atol=1e-5)
        assert abs(offset[0, 1]) > 1
