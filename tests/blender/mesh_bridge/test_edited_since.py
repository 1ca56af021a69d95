# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices moved, added and removed by hand on a result: from here, or from the original."""

from typing import Any

import bmesh
import bpy
import numpy as np
import pytest
from rich_mesh import points_of, position_of, set_points, set_position
from scene import add_copy, edit_mode
from snapshot import STORED, unchanged

NOTE = "cubic_craft_note"


def move_some(obj, rows=slice(40, 60), change=(0.1, -0.2, 0.3)):
    """Move vertices by hand in Edit Mode, which shifts all shape keys if Basis is active."""
    obj.active_shape_key_index = 0
    with edit_mode(obj) as bm:
        for vertex in bm.verts[rows]:
            vertex.co = tuple(np.add(vertex.co, change))


def run_in_edit_mode(obj, rows, *operators):
    """Select vertices in Edit Mode and call operators on them."""
    with edit_mode(obj) as bm:
        bm.select_mode = {"VERT"}
        for index, vertex in enumerate(bm.verts):
            vertex.select = index in rows
        bm.select_flush_mode()
        bmesh.update_edit_mesh(obj.data)
        for run in operators:
            run()


def test_from_here_replaces_the_original(bridge, cubify, monkey):
    mesh = monkey.data
    cubify(monkey)
    move_some(monkey)
    with unchanged(monkey, STORED):
        cubify(monkey, seed=3)
        assert not bridge.is_edited(mesh)
        stored = [a.name for a in mesh.attributes if a.name.startswith("cubic_craft")]
        assert len(stored) == 2 * (8 if mesh.shape_keys else 4)  # and those of the first original
        bridge.restore(monkey)
    bridge.discard_original(mesh)
    assert NOTE not in mesh and not bridge.has_traces(mesh)


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_from_the_original(bridge, cubify, monkey, result):
    """As if there had been no edit."""
    base = bridge.read_positions(monkey.data)
    twin = add_copy(monkey)
    cubify(monkey)
    move_some(monkey)
    one = cubify(monkey, result, 2, "ORIGINAL").data
    other = cubify(twin, result, 2).data
    if result == "NEW_OBJECT":
        assert bridge.is_edited(monkey.data)  # the source stays as it is
    assert np.array_equal(position_of(one), position_of(other))
    assert np.array_equal(bridge.original_positions(one), base)
    for key in one.shape_keys.key_blocks if one.shape_keys else ():
        np.testing.assert_allclose(points_of(one, key.name), points_of(other, key.name), atol=1e-6)


@pytest.mark.parametrize("share", [0.05, 0.5, 0.9, 1.0])
def test_however_much_is_edited(bridge, cubify, plain_monkey, share):
    """Nobody can tell a mesh that was all sculpted from nothing that was moved: it is in place."""
    mesh = plain_monkey.data
    base = bridge.read_positions(mesh)
    cubify(plain_monkey)
    points = position_of(mesh)
    rng = np.random.default_rng(3)
    rows = rng.permutation(len(points))[: round(share * len(points))]
    points[rows] += 0.1 * np.sin(7 * points[rows, ::-1])
    set_position(mesh, points)
    assert bridge.is_edited(mesh)
    assert bridge.original_positions(mesh, "ORIGINAL").tobytes() == base.tobytes()


@pytest.mark.parametrize("share", [0.05, 0.5, 1.0])
def test_transformed_and_edited(bridge, cubify, plain_monkey, share):
    mesh = plain_monkey.data
    base = bridge.read_positions(mesh)
    cubify(plain_monkey)
    linear = np.array([[0, -2, 0], [2, 0, 0], [0, 0, 2]], float)
    points = position_of(mesh) @ linear.T + (1, 2, 3)
    rows = np.random.default_rng(3).permutation(len(points))[: round(share * len(points))]
    points[rows] += 0.05 * np.sin(7 * points[rows, ::-1])
    set_position(mesh, points)
    assert bridge.is_edited(mesh)
    expected = base @ linear.T + (1, 2, 3)
    # Where every vertex was edited the transform is known only about.
    atol = 1e-5 if share < 1 else 0.25
    np.testing.assert_allclose(bridge.original_positions(mesh, "ORIGINAL"), expected, atol=atol)


def test_edit_of_a_shape_key_is_none_of_the_mesh(bridge, cubify, keyed_monkey):
    mesh = keyed_monkey.data
    cubify(keyed_monkey)
    points = points_of(mesh, "Wide")
    points[40:60] += 0.2
    set_points(mesh, "Wide", points)
    assert not bridge.is_edited(mesh)


def test_lost_note_loses_nothing(bridge, cubify, monkey):
    base = bridge.read_positions(monkey.data)
    cubify(monkey)
    del monkey.data[NOTE]
    bridge.restore(monkey)
    assert np.array_equal(bridge.read_positions(monkey.data), base)


@pytest.mark.parametrize("also_moved", [False, True])
def test_deleted_vertices(bridge, cubify, monkey, also_moved):
    """The others have their originals still; also where some of them were moved."""
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    names = mesh.shape_keys.key_blocks.keys() if mesh.shape_keys else []
    keys = {name: points_of(mesh, name) for name in names}
    cubify(monkey)
    rows = range(50, 80)
    run_in_edit_mode(monkey, rows, lambda: bpy.ops.mesh.delete(type="VERT"))
    assert len(mesh.vertices) == len(base) - 30
    if also_moved:
        move_some(monkey, slice(20, 30))
    assert bridge.is_edited(mesh) == also_moved
    bridge.restore(monkey)
    assert np.array_equal(bridge.read_positions(mesh), np.delete(base, rows, axis=0))
    for name, points in keys.items():
        np.testing.assert_allclose(points_of(mesh, name), np.delete(points, rows, 0), atol=1e-6)


def test_extruded_side_goes_along(bridge, cubify):
    """What is moved as a whole has the original of the side that it was made from, moved alike."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8)
    obj: Any = bpy.context.object
    mesh = obj.data
    base = bridge.read_positions(mesh)
    cubify(obj)
    written = bridge.read_positions(mesh)
    rows = np.flatnonzero(base[:, 2] > 0.3)

    def extrude():
        bpy.ops.mesh.extrude_region_move(TRANSFORM_OT_translate={"value": (0, 0, 0.5)})

    run_in_edit_mode(obj, rows, extrude)
    present = bridge.read_positions(mesh)
    assert len(present) > len(written)
    bridge.restore(obj)
    restored = bridge.read_positions(mesh)
    for point, result in zip(restored, present, strict=True):
        row = np.abs(written + (0, 0, 0.5) - result).max(axis=1).argmin()
        is_up = np.abs(written[row] + (0, 0, 0.5) - result).max() < 1e-5
        if not is_up:
            row = np.abs(written - result).max(axis=1).argmin()
        np.testing.assert_allclose(point, base[row] + (0, 0, 0.5 * is_up), atol=1e-5)


def test_extruded_and_shaped_is_the_original(bridge, cubify, error, plain_monkey):
    """Nobody can tell the originals of new vertices that were moved each its own way."""
    mesh = plain_monkey.data
    cubify(plain_monkey)

    def extrude():
        bpy.ops.mesh.extrude_region_move(TRANSFORM_OT_translate={"value": (0, 0, 0.5)})
        bm = bmesh.from_edit_mesh(mesh)
        for vertex in bm.verts:
            if vertex.select:
                vertex.co = np.multiply(vertex.co, 1 + np.sin(9 * np.array(vertex.co)))
        bmesh.update_edit_mesh(mesh)

    run_in_edit_mode(plain_monkey, range(100, 200), extrude)
    shape = bridge.read_positions(mesh)
    assert not bridge.has_original(mesh) and bridge.has_traces(mesh) and bridge.starts_here(mesh)
    for start in ("HERE", "ORIGINAL"):
        assert bridge.original_positions(mesh, start).tobytes() == shape.tobytes()
    with (
        unchanged(plain_monkey),
        pytest.raises(error, match=r'"Suzanne" has been edited .* no longer be determined.* Apply'),
    ):
        bridge.restore(plain_monkey)
    cubify(plain_monkey)
    bridge.restore(plain_monkey)
    assert bridge.read_positions(mesh).tobytes() == shape.tobytes()
