# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights, measures, components and the unit box, by hand and by identities."""

import numpy as np
import pytest
import scipy.sparse as sp
import shapes
from scipy.sparse.csgraph import connected_components

from solver import PAPER
from solver.mesh.components import components
from solver.mesh.cotangents import MAX_COTANGENT, cotangents
from solver.mesh.rest_measures import areas_and_normals
from solver.mesh.unit_box import unit_box
from solver.preparation import rest_mesh

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


@pytest.mark.parametrize("vertices", [3, 60, 300, 2000])
def test_components_are_those_of_scipy(vertices):
    # from one component to triangles on their own, chains included; the numbers are shuffled
    random = np.random.default_rng(vertices)
    chain = np.arange(40)[:, None] * 2 + [0, 1, 2] + vertices
    F = np.concatenate([random.integers(0, vertices, (150, 3)), chain])
    n = vertices + 100
    F = random.permutation(n)[F]
    a, b = F[:, [0, 1]].ravel(), F[:, [1, 2]].ravel()
    graph = sp.coo_matrix((np.ones(len(a)), (a, b)), shape=(n, n))
    expected_count, expected = connected_components(graph, directed=False)
    count, labels = components(F, n)
    assert count == expected_count
    np.testing.assert_array_equal(labels, expected)


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
