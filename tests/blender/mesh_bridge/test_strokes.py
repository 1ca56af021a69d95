# SPDX-License-Identifier: GPL-3.0-or-later
"""What was moved by hand on a result is put back onto the next one, which starts from the original.

"The sculpted shape" is that of the result with the seed 1, as it was moved by hand.
"""

from dataclasses import asdict

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from results import write
from rich_mesh import cubic_like, points_of, position_of, set_position
from scene import add_copy, bmesh_of
from sculpting import check_bits, check_near, sculpt, shapes_of
from snapshot import unchanged


def test_other_cubeness_and_back_is_the_sculpted_shape(bridge, cubify, monkey):
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    cubify(monkey, seed=1)
    sculpt(monkey)
    sculpted = shapes_of(monkey)
    cubify(monkey, seed=2, start="EDITS")
    assert not bridge.is_edited(mesh) and bridge.has_strokes(mesh)
    assert bridge.original_positions(mesh, "EDITS").tobytes() == base.tobytes()
    cubify(monkey, seed=1, start="EDITS")
    check_near(shapes_of(monkey), sculpted)


def test_a_stroke_turns_with_its_vertex(bridge, cubify, plain_monkey):
    mesh, twin = plain_monkey.data, add_copy(plain_monkey)
    base = bridge.original_positions(mesh)
    before, after = (cubic_like(base, seed)[1][40:60] for seed in (1, 2))
    cubify(plain_monkey, seed=1)
    written = position_of(mesh)
    sculpt(plain_monkey)
    offset = (position_of(mesh).astype(np.float64) - written)[40:60]
    cubify(plain_monkey, seed=2, start="EDITS")
    cubify(twin, seed=2)
    expected = position_of(twin.data)
    expected[40:60] += np.einsum("nij,nkj,nk->ni", after, before, offset)
    np.testing.assert_allclose(position_of(mesh), expected, atol=2e-6)
    still = np.delete(np.arange(len(base)), slice(40, 60))
    assert np.array_equal(position_of(mesh)[still], expected[still])


@pytest.mark.parametrize("is_written_again", [False, True])
def test_restore_and_from_the_original_drop_them(bridge, cubify, monkey, is_written_again):
    mesh = monkey.data
    twin = add_copy(monkey)
    with unchanged(monkey):
        cubify(monkey, seed=1)
        sculpt(monkey)
        if is_written_again:
            cubify(monkey, seed=2, start="EDITS")
        bridge.restore(monkey)
    assert not bridge.has_traces(mesh)
    cubify(monkey, seed=1, start="EDITS")
    cubify(twin, seed=1)
    assert position_of(mesh).tobytes() == position_of(twin.data).tobytes()
    sculpt(monkey)
    if is_written_again:
        cubify(monkey, seed=2, start="EDITS")
    cubify(monkey, seed=1, start="ORIGINAL")
    assert position_of(mesh).tobytes() == position_of(twin.data).tobytes()
    assert not bridge.has_strokes(mesh)


def test_apply_keeps_the_shape_and_drops_them(bridge, cubify, monkey):
    cubify(monkey, seed=1)
    sculpt(monkey)
    cubify(monkey, seed=2, start="EDITS")
    shapes = shapes_of(monkey)
    bridge.discard_original(monkey.data)
    check_near(shapes_of(monkey), shapes)
    assert not bridge.has_traces(monkey.data)


@pytest.mark.parametrize("moment", ["before", "after"])
def test_they_are_transformed_with_the_mesh(bridge, cubify, plain_monkey, moment):
    mesh = plain_monkey.data
    linear = np.array([[0, -2, 0], [2, 0, 0], [0, 0, 2]], float)

    def transform():
        set_position(mesh, position_of(mesh) @ linear.T + (1, 2, 3))

    positions, rotations = cubic_like(bridge.original_positions(mesh), 1)
    bridge.write_mesh(mesh, positions, rotations)
    sculpt(plain_monkey)
    sculpted = position_of(mesh)
    if moment == "after":
        bridge.write_mesh(mesh, positions, rotations, start="EDITS")
    transform()
    turned = linear @ rotations @ np.linalg.inv(linear)
    bridge.write_mesh(mesh, positions @ linear.T + (1, 2, 3), turned, start="EDITS")
    np.testing.assert_allclose(position_of(mesh), sculpted @ linear.T + (1, 2, 3), atol=1e-5)


def test_those_in_our_shape_key_are_transformed_with_the_mesh(bridge, plain_monkey):
    mesh, linear = plain_monkey.data, np.array([[0.0, -2, 0], [2, 0, 0], [0, 0, 2]])
    positions, rotations = cubic_like(bridge.original_positions(mesh), 1)
    bridge.write_mesh(mesh, positions, rotations)
    sculpt(plain_monkey)
    bridge.write_shape_key(plain_monkey, positions, rotations, start="EDITS")
    sculpted = points_of(mesh, "Cubic")
    mesh.transform(Matrix(linear).to_4x4(), shape_keys=True)
    turned = linear @ rotations @ np.linalg.inv(linear)
    bridge.write_shape_key(plain_monkey, positions @ linear.T, turned, start="EDITS")
    np.testing.assert_allclose(points_of(mesh, "Cubic"), sculpted @ linear.T, atol=1e-5)


def test_vertices_that_are_deleted_take_theirs_along(bridge, cubify, plain_monkey):
    mesh = plain_monkey.data
    positions, rotations = cubic_like(bridge.original_positions(mesh), 1)
    bridge.write_mesh(mesh, positions, rotations)
    sculpt(plain_monkey, slice(40, 60))
    bridge.write_mesh(mesh, positions, rotations, start="EDITS")
    rows = np.r_[50:56, 100:130]
    with bmesh_of(mesh) as bm:
        bm.verts.ensure_lookup_table()
        for vertex in [bm.verts[row] for row in rows]:
            bm.verts.remove(vertex)
    sculpted = position_of(mesh)
    left = [np.delete(values, rows, axis=0) for values in (positions, rotations)]
    assert bridge.has_original(mesh)
    bridge.write_mesh(mesh, *left, start="EDITS")
    in_faces = np.unique([row for face in mesh.polygons for row in face.vertices])
    np.testing.assert_allclose(position_of(mesh)[in_faces], sculpted[in_faces], atol=2e-6)


@pytest.mark.parametrize("result", ["SHAPE_KEY", "NEW_OBJECT"])
def test_other_results_have_them_too(bridge, cubify, monkey, result):
    twin = add_copy(monkey)
    for obj in (monkey, twin):
        cubify(obj, seed=1)
        sculpt(obj)
    cubify(twin, seed=2, start="EDITS")
    sculpted = shapes_of(twin)
    made = cubic_like(bridge.original_positions(monkey.data, "EDITS"), 2)
    if result == "NEW_OBJECT":
        with unchanged(monkey):
            new = write(bridge, monkey, result, *made, "EDITS")
            new.select_set(False)
            monkey.select_set(True)
            bpy.context.view_layer.objects.active = monkey
        check_near(shapes_of(new), sculpted)
        return
    for _ in range(2):  # the second finds them with the key
        bridge.write_shape_key(monkey, *made, start="EDITS")
        np.testing.assert_allclose(points_of(monkey.data, "Cubic"), sculpted[0], atol=2e-6)
    cubify(monkey, seed=2, start="EDITS")
    check_near(shapes_of(monkey), sculpted)
    bridge.restore(monkey)
    assert not bridge.has_traces(monkey.data)


def test_flattened_facets_keep_them(bridge, cubify, monkey):
    """Flattening changes the result only; the next one has no facets, but the strokes."""
    mesh = monkey.data
    cubify(monkey, seed=1)
    sculpt(monkey)
    sculpted = shapes_of(monkey)
    bridge.write_reshaped(monkey, bridge.result_positions(monkey) * (1, 1, 0.9))
    assert not bridge.is_edited(mesh)
    cubify(monkey, seed=1, start="EDITS")
    check_near(shapes_of(monkey), sculpted)


def test_a_preview_shows_them(bridge, cubify, monkey):
    mesh = monkey.data
    cubify(monkey, seed=1)
    sculpt(monkey)
    made = cubic_like(bridge.original_positions(mesh, "EDITS"), 2)
    with unchanged(monkey):
        preview = bridge.Preview(mesh, "EDITS")
        assert preview.needs_rotations
        preview.show(mesh, *made)
        shown = shapes_of(monkey)
        bridge.end_preview(mesh)
    bridge.write_mesh(mesh, *made, start="EDITS")
    check_bits(shown, shapes_of(monkey))


def test_strokes_that_are_not_finite_are_refused(bridge, cubify, error, plain_monkey):
    """Before anything is solved."""
    mesh = plain_monkey.data
    cubify(plain_monkey, seed=1)
    points = position_of(mesh)
    points[40, 0] = np.nan
    set_position(mesh, points)
    with pytest.raises(error, match="coordinates that are not finite: delete those vertices"):
        bridge.original_positions(mesh, "EDITS")
    with pytest.raises(error, match="coordinates that are not finite: delete those vertices"):
        bridge.Preview(mesh, "EDITS")
    bridge.restore(plain_monkey)
    assert np.isfinite(position_of(mesh)).all()


def test_a_file_with_a_preview_keeps_them(bridge, cubify, monkey):
    mesh = monkey.data
    run = bridge.LastRun({}, 1, 1, 1, 0.0, True, 0.0, "numpy")
    cubify(monkey, seed=1)
    sculpt(monkey)
    sculpted = shapes_of(monkey)
    preview = bridge.Preview(mesh, "EDITS")
    preview.show(mesh, *cubic_like(bridge.original_positions(mesh, "EDITS"), 2))
    shown = shapes_of(monkey)
    bridge.keep_preview(mesh, asdict(run), "EDITS")
    check_bits(shapes_of(monkey), shown)
    cubify(monkey, seed=1, start="EDITS")
    check_near(shapes_of(monkey)[:1], sculpted[:1])
