# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights, measures, components and the unit box, by hand and by identities; what is refused."""

import numpy as np
import pytest
import shapes

from solver import PAPER, CubicCraftError
from solver.mesh import polygons
from solver.mesh.components import components
from solver.mesh.mesh_checks import check_mesh
from solver.mesh.rest_measures import MAX_COTANGENT, areas_and_normals, cotangents
from solver.mesh.unit_box import unit_box
from solver.surface.preparation import rest_mesh

RIGHT = np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0]])
ONE = np.array([[0, 1, 2]])


def test_cotangents_of_a_right_triangle():
    # right angle at corner 0; tan at corner 1 is 1/2, at corner 2 it is 2
    np.testing.assert_allclose(cotangents(RIGHT, ONE), [[0.0, 2.0, 0.5]], atol=1e-15)


@pytest.mark.parametrize(
    "corners",
    [
        [[0, 0, 0], [0, 0, 0], [0, 0, 0]],
        [[0, 0, 0], [1, 0, 0], [1, 0, 0]],
        [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
        [[0, 0, 0], [1, 0, 0], [0.3, 1e-9, 0]],
        [[0, 0, 0], [1e-9, 0, 0], [0, 1, 0]],
    ],
)
def test_degenerate_triangles_are_bounded_and_tie_their_corners_together(corners):
    C = cotangents(np.array(corners, float), ONE)[0]
    assert np.isfinite(C).all()
    assert np.abs(C).max() <= 1.01 * MAX_COTANGENT
    a, b, c = C
    L = np.array([[b + c, -c, -b], [-c, a + c, -a], [-b, -a, a + b]])
    zero, *others = np.linalg.eigvalsh(L)
    assert abs(zero) < 1e-9 * MAX_COTANGENT
    assert min(others) > 1e-4  # positive definite but for translations


def test_areas_and_normals_of_a_tetrahedron_corner():
    V = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    F = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2]])
    areas, normals = areas_and_normals(V, F)
    np.testing.assert_allclose(areas, [0.5, 1 / 3, 1 / 3, 1 / 3])
    np.testing.assert_allclose(normals[0], -np.ones(3) / 3**0.5)
    np.testing.assert_allclose(normals[1], -np.array([0, 1, 1]) / 2**0.5)


def test_a_normal_that_cancels_out_is_zero():
    _, normals = areas_and_normals(RIGHT, np.array([[0, 1, 2], [0, 2, 1]]))
    assert (normals == 0.0).all()


def test_components_count_parts_and_loose_vertices():
    V, F = shapes.two_blobs()
    count, labels = components(F, len(V))
    assert count == 3
    loose = len(shapes.blob(2)[0])
    assert (labels == labels[loose]).sum() == 1
    assert len(np.unique(labels[:loose])) == 1


@pytest.mark.parametrize("name", shapes.ALL)
def test_edge_sums_of_a_rest_mesh(name):
    rest = rest_mesh(*shapes.ALL[name](), proxy=PAPER)
    L = rest.matrices.matrix(rest.matrices.laplacian).tocoo()
    expected = np.zeros(rest.topology.component_count)
    for i, j, value in zip(L.row, L.col, L.data, strict=True):
        edge = rest.V[j] - rest.V[i]
        expected[rest.topology.component[i]] -= value * edge @ edge
    np.testing.assert_allclose(rest.edge_sums, expected, rtol=1e-12)


def test_a_rest_mesh_leaves_out_loose_vertices_and_keeps_none_of_the_callers_triangles():
    V, F = shapes.blob(1)
    F = F.astype(np.int32)
    rest, triangles = rest_mesh(V, F, PAPER), F.copy()
    F[:] = 0
    np.testing.assert_array_equal(rest.F, triangles)
    among_loose = np.full((2 * len(V), 3), 9.0)
    among_loose[1::2] = V
    other = rest_mesh(among_loose, 2 * triangles + 1, PAPER)
    np.testing.assert_array_equal(other.used, np.arange(1, 2 * len(V), 2))
    np.testing.assert_array_equal(other.V, rest.V)
    np.testing.assert_array_equal(other.F, rest.F)


def test_unit_box_there_and_back():
    V, _ = shapes.blob()
    box = unit_box(V)
    unit = box.to_unit(V)
    assert shapes.extent(unit) == pytest.approx(1.0)
    np.testing.assert_array_equal(unit.min(axis=0), 0.0)
    np.testing.assert_allclose(box.from_unit(unit), V, atol=1e-15)


V = np.eye(3)
F = np.array([[0, 1, 2]])


@pytest.mark.parametrize(
    ("V", "F", "message"),
    [
        (V[:, :2], F, r"positions must have the shape \(n, 3\)"),
        (V, F[:, :2], r"triangles must have the shape \(m, 3\)"),
        (V, F[:0], "no faces"),
        (V[:2], F % 2, "only 2 vertices"),
        (V, F.astype(float), "must be integers"),
        (V, F + 1, "only 3"),
        (V, F - 1, "-1 to 1"),
        (V + [0, np.nan, 0], F, "not finite"),
        (V * 1j, F, "positions must be real numbers, not complex128"),
        (V.astype(str), F, "positions must be real numbers, not text"),
        ("bunny.obj", F, "positions must be real numbers, not text"),
        ([[0, 0, 0], [1, 0]], F, "whose rows are of one length"),
        (None, F, "positions must be real numbers, not None"),
        (V, None, r"must have the shape \(m, 3\)"),
        (V, [[0, 1, 2], [0, 1]], r"must have the shape \(m, 3\), not \(1, 2\)"),
        (V, [[0, 1, 2], [0, 1, "2", 0]], "must be integers"),
        (V, [[[0], [1]], [0, 1, 2]], "rows of vertex numbers"),
        (V, np.repeat(F, 5, axis=0).T, "a face with 5 corners has the vertex 0 twice"),
        (V + [[0, 0, 0], [0, np.inf, 0], [0, 0, 0]], F, "the first is vertex 1"),
    ],
)
def test_refusals(V, F, message):
    with pytest.raises(CubicCraftError, match=message) as caught:
        check_mesh(V, F)
    assert "\n" not in str(caught.value)


def test_polygons_become_triangles():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 2, 0], [0, 0, 1]])
    quads = [[0, 1, 2, 3], [3, 0, 1, 5]]
    assert len(check_mesh(V, quads)[1]) == len(check_mesh(V, np.array(quads))[1]) == 4
    rows = [[0, 1, 5], [0, 1, 2, 4, 3], [3, 0, 5]]
    for faces in (rows, tuple(map(np.array, rows)), np.array(rows, dtype=object)):
        triangles = check_mesh(V, faces)[1]
        assert triangles.dtype == np.int32
        assert triangles[:2].tolist() == [rows[0], rows[2]]
        assert triangles.shape == (5, 3) and set(triangles[2:].ravel()) == {0, 1, 2, 3, 4}


def test_lists_and_32_bit_arrays_are_taken():
    checked_V, checked_F = check_mesh(V.astype(np.float32).tolist(), F.tolist())
    assert checked_V.dtype == np.float64
    assert checked_F.dtype == np.int32


def test_without_earcut_large_concave_faces_are_refused(monkeypatch):
    monkeypatch.setattr(polygons, "optional_package", lambda name: None)
    angles = np.arange(200) * np.pi / 100
    radii = 1.0 + 0.5 * np.cos(5.0 * angles)
    V = np.stack([radii * np.cos(angles), radii * np.sin(angles), 0.0 * angles], axis=1)
    with pytest.raises(CubicCraftError, match="200 corners; for more than 100, install mapbox"):
        check_mesh(V, [range(200)])
    assert check_mesh(V[::4], [range(50)])[1].shape == (48, 3)
