# SPDX-License-Identifier: GPL-3.0-or-later
"""Auto Orient against shapes whose answer is known, and against a dense search."""

import numpy as np
import pytest
import shapes
from scipy.spatial.transform import Rotation

from solver import auto_orient, nearest_to_identity, triangle_areas_and_normals

CUBE = np.concatenate([np.eye(3), -np.eye(3)])


def cost(Q, normals, areas):
    return areas @ np.abs(normals @ Q.T).sum(axis=1)


@pytest.mark.parametrize("seed", range(8))
def test_a_turned_box_is_found(seed):
    turn = Rotation.random(random_state=seed).as_matrix()
    areas = np.array([1.0, 2.0, 3.0, 1.0, 2.0, 3.0])
    Q = auto_orient(CUBE @ turn.T, areas)
    assert np.linalg.det(Q) == pytest.approx(1.0)
    assert cost(Q, CUBE @ turn.T, areas) == pytest.approx(12.0, abs=1e-6)
    same = np.abs(Q @ turn)  # a signed permutation
    np.testing.assert_allclose(same.max(axis=0), 1.0, atol=1e-4)


def test_the_result_is_the_smallest_of_its_24_turns():
    areas, normals = triangle_areas_and_normals(*shapes.blob(2))
    Q = auto_orient(normals, areas)
    angle = Rotation.from_matrix(Q).magnitude()
    others = Rotation.create_group("O") * Rotation.from_matrix(Q)
    assert angle == pytest.approx(others.magnitude().min())
    np.testing.assert_allclose(nearest_to_identity(others[7].as_matrix()), Q, atol=1e-12)


@pytest.mark.parametrize("name", ["blob", "skewed_blob", "sheet", "two_blobs"])
def test_no_orientation_of_a_dense_search_is_better(name):
    areas, normals = triangle_areas_and_normals(*shapes.ALL[name]())
    best = cost(auto_orient(normals, areas), normals, areas)
    for Q in Rotation.random(10000, random_state=5).as_matrix():
        assert cost(Q, normals, areas) >= best * (1 - 1e-6)


def test_it_does_not_depend_on_how_the_shape_stands():
    V, F = shapes.skewed_blob()
    costs = []
    for angles in ((0, 0, 0), (10, 70, -40), (33, -5, 120)):
        areas, normals = triangle_areas_and_normals(V @ shapes.rotation(*angles).T, F)
        costs.append(cost(auto_orient(normals, areas), normals, areas))
    np.testing.assert_allclose(costs, costs[0], rtol=1e-5)


def test_without_normals_nothing_is_turned():
    np.testing.assert_array_equal(auto_orient(np.zeros((4, 3)), np.ones(4)), np.eye(3))
    np.testing.assert_array_equal(auto_orient(CUBE, np.zeros(6)), np.eye(3))
