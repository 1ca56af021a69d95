# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read of a mesh: rotations, weights of vertex groups, and triangles."""

import importlib

import bpy
import numpy as np
import pytest
from mathutils import Quaternion
from rich_mesh import cubic_like, set_position


@pytest.fixture
def rotations(bridge):
    return importlib.import_module(f"{bridge.__name__}.access.rounded_for_storage")


def test_there_and_back(rotations):
    matrices = cubic_like(np.zeros((500, 3)))[1]
    quaternions = rotations.quaternions_from_matrices(matrices)
    assert quaternions.dtype == np.float32
    back = rotations.matrices_from_quaternions(quaternions)
    np.testing.assert_allclose(back, matrices, atol=5e-7)
    np.testing.assert_allclose(back @ back.transpose(0, 2, 1), [np.eye(3)] * 500, atol=1e-15)


def test_as_blender_reads_them(rotations):
    matrix = cubic_like(np.zeros((1, 3)))[1][0]
    quaternion = Quaternion(rotations.quaternions_from_matrices(matrix[None])[0])
    np.testing.assert_allclose(np.array(quaternion.to_matrix()), matrix, atol=1e-6)


def test_half_turns(rotations):
    """Where the real part vanishes, and with it the simple formula."""
    turns = np.array([np.diag(d) for d in ((1, -1, -1), (-1, 1, -1), (-1, -1, 1))], float)
    quaternions = rotations.quaternions_from_matrices(turns)
    assert np.array_equal(quaternions, np.eye(4)[1:])
    assert np.array_equal(rotations.matrices_from_quaternions(quaternions), turns)


def test_identity_is_exact(rotations):
    quaternions = rotations.quaternions_from_matrices(np.eye(3)[None])
    assert quaternions.tolist() == [[1, 0, 0, 0]]
    assert np.array_equal(rotations.matrices_from_quaternions(quaternions)[0], np.eye(3))


@pytest.fixture
def cube():
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.object


def test_weights(bridge, cube):
    for name in ("Other", "Map"):
        cube.vertex_groups.new(name=name).add([0, 2], 0.75, "REPLACE")
    cube.vertex_groups["Other"].add([3, 5], 0.5, "REPLACE")
    cube.vertex_groups["Map"].add([2, 5], 0.25, "REPLACE")
    cube.vertex_groups["Map"].add([6], 0.0, "REPLACE")
    weights = bridge.group_weights(cube, "Map")
    assert weights.dtype == np.float64
    assert weights.tolist() == [0.75, 0, 0.25, 0, 0, 0.25, 0, 0]
    both = bridge.weights_of_groups(cube, ("Other", "Map"))
    assert both["Map"].tolist() == weights.tolist()
    assert both["Other"].tolist() == [0.75, 0, 0.75, 0.5, 0, 0.5, 0, 0]


@pytest.mark.parametrize("name", ["Missing", "map", ""])
def test_missing_group(bridge, error, cube, name):
    cube.vertex_groups.new(name="Map")
    with pytest.raises(error, match=f'"Cube" has no vertex group "{name}"; pick another'):
        bridge.group_weights(cube, name)


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


@pytest.mark.parametrize("size", [3, 4])
@pytest.mark.parametrize("vertex", [-1, 2_000_000_000])
def test_a_vertex_that_is_not_there_is_refused(bridge, error, size, vertex):
    mesh = mesh_of([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [range(size)])
    mesh.loops.foreach_set("vertex_index", np.array([*range(size - 1), vertex], np.int32))
    with pytest.raises(error, match=f'"Cut" refers to vertex {vertex}, but there are only 4'):
        bridge.triangles(mesh, bridge.read_positions(mesh))
