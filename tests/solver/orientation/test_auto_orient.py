# SPDX-License-Identifier: GPL-3.0-or-later
"""Auto Orient against shapes whose answer is known, and against a dense search."""

import numpy as np
import pytest
import shapes
from named_forms import POLYTOPES
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from solver import auto_orient, triangle_areas_and_normals
from solver.styles.polytope import from_directions, from_points
from solver.styles.symmetries import symmetries

CUBE = np.concatenate([np.eye(3), -np.eye(3)])
EXACT = np.radians(0.2)
# With many symmetries, few and none; regular, with a base, and with very many sides.
each_form = pytest.mark.parametrize(
    "name", ["box", "octahedron", "tetrahedron", "icosahedron", "cylinder", "prism of 5", "pyramid"]
)


def cost(Q, normals, areas):
    return areas @ np.abs(normals @ Q.T).sum(axis=1)


def cost_of(form, Q, normals, areas):
    return areas @ form.cost(normals @ Q.T)


def surface(form):
    """Return the areas and normals of the triangles of a form."""
    triangles = ConvexHull(form.vertices)
    areas, normals = triangle_areas_and_normals(form.vertices, triangles.simplices)
    inward = (normals * triangles.equations[:, :3]).sum(axis=1) < 0.0
    return areas, np.where(inward[:, None], -normals, normals)


def angle_between(Q, other, form):
    """Return the angle from Q to the nearest rotation that is equivalent to another."""
    return Rotation.from_matrix(symmetries(form) @ other @ Q.T).magnitude().min()


def random_form(seed, count):
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    return from_directions(directions)


@pytest.mark.thorough(4)
@pytest.mark.parametrize("seed", range(8))
def test_a_turned_box_is_found(seed):
    turn = Rotation.random(random_state=seed).as_matrix()
    areas = np.array([1.0, 2.0, 3.0, 1.0, 2.0, 3.0])
    Q = auto_orient(CUBE @ turn.T, areas)
    assert np.linalg.det(Q) == pytest.approx(1.0)
    assert cost(Q, CUBE @ turn.T, areas) == pytest.approx(12.0, abs=1e-6)
    same = np.abs(Q @ turn)  # a signed permutation
    np.testing.assert_allclose(same.max(axis=0), 1.0, atol=1e-4)


@pytest.mark.thorough(2)
@pytest.mark.parametrize("name", ["blob", "skewed_blob", "sheet", "two_blobs"])
def test_no_orientation_of_a_dense_search_is_better(name):
    areas, normals = triangle_areas_and_normals(*shapes.ALL[name]())
    best = cost(auto_orient(normals, areas), normals, areas)
    for Q in Rotation.random(10000, random_state=5).as_matrix():
        assert cost(Q, normals, areas) >= best * (1 - 1e-6)


def test_without_normals_nothing_is_turned():
    np.testing.assert_array_equal(auto_orient(np.zeros((4, 3)), np.ones(4)), np.eye(3))
    np.testing.assert_array_equal(auto_orient(CUBE, np.zeros(6)), np.eye(3))


@pytest.mark.thorough(5)
@each_form
@pytest.mark.parametrize("seed", range(2))
def test_a_turned_form_is_found(name, seed):
    form = POLYTOPES[name]()
    areas, normals = surface(form)
    turn = Rotation.random(random_state=seed).as_matrix()
    Q = auto_orient(normals @ turn.T, areas, form)
    assert np.linalg.det(Q) == pytest.approx(1.0)
    assert angle_between(Q, turn.T, form) < EXACT
    least = cost_of(form, turn.T, normals @ turn.T, areas)
    assert cost_of(form, Q, normals @ turn.T, areas) == pytest.approx(least, rel=1e-3)


@pytest.mark.thorough(1)
@pytest.mark.parametrize(
    "make",
    [
        lambda: random_form(1, 20),
        lambda: random_form(2, 120),
        lambda: from_points(np.random.default_rng(3).normal(size=(30, 3))),
    ],
)
def test_a_turned_form_without_symmetries_is_found(make):
    form = make()
    areas, normals = surface(form)
    turn = Rotation.random(random_state=7).as_matrix()
    assert angle_between(auto_orient(normals @ turn.T, areas, form), turn.T, form) < EXACT


@each_form
def test_a_form_that_stands_as_it_is_stays_exactly(name):
    form = POLYTOPES[name]()
    areas, normals = surface(form)
    np.testing.assert_allclose(auto_orient(normals, areas, form), np.eye(3), atol=1e-9)


@pytest.mark.thorough(2)
@each_form
def test_no_orientation_of_a_form_in_a_dense_search_is_better(name):
    form = POLYTOPES[name]()
    areas, normals = triangle_areas_and_normals(*shapes.skewed_blob())
    best = cost_of(form, auto_orient(normals, areas, form), normals, areas)
    for Q in Rotation.random(1000, random_state=5).as_matrix():
        assert cost_of(form, Q, normals, areas) >= best * (1 - 1e-6)


def test_without_normals_no_form_is_turned():
    form = POLYTOPES["tetrahedron"]()
    np.testing.assert_array_equal(auto_orient(np.zeros((4, 3)), np.ones(4), form), np.eye(3))
    np.testing.assert_array_equal(auto_orient(CUBE, np.zeros(6), form), np.eye(3))
