# SPDX-License-Identifier: GPL-3.0-or-later
import bpy
import numpy as np
import pytest
from rich_mesh import cubic_like, set_position


def mesh_of(points, faces):
    mesh = bpy.data.meshes.new("Cut")
    mesh.from_pydata(points, [], faces)
    return mesh


def test_triangles_are_taken_as_they_are(bridge):
    faces = [(2, 0, 1), (1, 3, 2)]
    mesh = mesh_of([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (5, 5, 5)], faces)
    triangles = bridge.triangles(mesh, bridge.read_positions(mesh))
    assert triangles.dtype == np.int32
    assert triangles.tolist() == [list(face) for face in faces]


def test_as_blender_cuts_them(bridge, monkey):
    mesh = monkey.data
    mesh.calc_loop_triangles()
    expected = [triangle.vertices[:] for triangle in mesh.loop_triangles]
    sizes = {len(face.vertices) for face in mesh.polygons}
    assert 3 in sizes and 4 in sizes and max(sizes) > 5
    triangles = bridge.triangles(mesh, bridge.read_positions(mesh))
    assert [tuple(triangle) for triangle in triangles.tolist()] == expected
    loose = np.arange(len(mesh.vertices) - 4, len(mesh.vertices))
    assert not np.isin(triangles, loose).any()


def test_the_given_shape_is_cut_and_not_the_present_one(bridge):
    """An arrowhead quad must be cut through its inner corner, which is not always the same."""
    faces = [(0, 1, 2, 3)]
    arrow = np.array([(0, 0, 0), (2, -1, 0), (0.5, 0, 0), (2, 1, 0)], np.float32)
    turned = np.roll(arrow, 1, axis=0)
    cuts = []
    for shape in (arrow, turned):
        mesh = mesh_of(shape.tolist(), faces)
        cuts.append(bridge.triangles(mesh, shape))
        set_position(mesh, arrow if shape is turned else turned)
        assert np.array_equal(bridge.triangles(mesh, shape), cuts[-1])
    assert not np.array_equal(*cuts)


def test_after_cubify_as_before(bridge, monkey):
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    before = bridge.triangles(mesh, base)
    bridge.write_mesh(mesh, *cubic_like(base))
    assert np.array_equal(bridge.triangles(mesh, bridge.original_positions(mesh)), before)
    rng = np.random.default_rng(0)
    crumpled = base + rng.normal(0, 0.3, base.shape).astype(np.float32)
    assert not np.array_equal(bridge.triangles(mesh, crumpled), before)


@pytest.mark.parametrize("size", [3, 4])
@pytest.mark.parametrize("vertex", [-1, 2_000_000_000])
def test_a_vertex_that_is_not_there_is_refused(bridge, error, size, vertex):
    mesh = mesh_of([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [range(size)])
    mesh.loops.foreach_set("vertex_index", np.array([*range(size - 1), vertex], np.int32))
    with pytest.raises(error, match=f'"Cut" refers to vertex {vertex}, but there are only 4'):
        bridge.triangles(mesh, bridge.read_positions(mesh))
