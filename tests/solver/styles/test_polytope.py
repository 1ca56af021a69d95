# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex bodies from directions and from points: faces, sizes and hulls, and what is refused."""

import time

import numpy as np
import pytest
import shapes
from named_forms import POLYTOPES
from scipy.spatial import ConvexHull

from solver import CubicCraftError
from solver.styles.faces import faces_of
from solver.styles.hulls import MANY_POINTS, simple_hull
from solver.styles.polytope import from_directions, from_points

COUNTS = {
    "cube": (8, 12, 6),
    "rounded cube": (24, 48, 26),
    "octahedron": (6, 12, 8),
    "tetrahedron": (4, 6, 4),
    "dodecahedron": (20, 30, 12),
    "icosahedron": (12, 30, 20),
    "rhombic dodecahedron": (14, 24, 12),
    "prism of 5": (10, 15, 7),
    "pyramid": (5, 8, 5),
}


@pytest.mark.parametrize("name", POLYTOPES)
def test_vertices_edges_and_facets(name):
    body = POLYTOPES[name]()
    counts = len(body.vertices), len(body.edges), len(body.normals)
    assert counts == COUNTS.get(name, counts)
    assert counts[0] - counts[1] + counts[2] == 2
    heights = body.vertices @ body.normals.T - body.offsets
    assert heights.max() < 1e-9
    assert (body.incidence.sum(axis=0) >= 3).all() and (body.incidence.sum(axis=1) >= 3).all()


@pytest.mark.parametrize("noise", [1e-8, 1e-7, 1e-6])
@pytest.mark.parametrize("left", range(6))
def test_no_side_is_lost_where_many_meet_but_for_rounding(noise, left):
    """Ten of the twelve directions of a dodecahedron, of which five meet at a corner."""
    d = POLYTOPES["dodecahedron"]().normals
    axis = d[left]
    d = d[np.abs(d @ axis) < 0.9]
    assert len(d) == 10
    d = d + noise * np.random.default_rng(left).normal(size=d.shape)
    body = from_directions(d)
    assert len(body.normals) == 10
    assert len(body.vertices) - len(body.edges) + len(body.normals) == 2
    assert (body.incidence.sum(axis=1).max()) == 5


@pytest.mark.parametrize("name", POLYTOPES)
def test_the_cost_of_a_normal_is_least_where_a_side_faces(name):
    body = POLYTOPES[name]()
    x = np.random.default_rng(1).normal(size=(2000, 3))
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    at_sides = body.cost(body.normals)
    np.testing.assert_allclose(at_sides, body.offsets, rtol=1e-9)
    assert body.cost(x).min() >= at_sides.min() * (1 - 1e-9)
    assert body.cost(x).max() <= body.radius * (1 + 1e-9)


def test_the_cost_of_the_cube_is_the_sum_of_sizes():
    x = np.random.default_rng(2).normal(size=(100, 3))
    np.testing.assert_allclose(POLYTOPES["cube"]().cost(x), np.abs(x).sum(axis=1))
    np.testing.assert_allclose(POLYTOPES["box"]().cost(x), np.abs(x) @ [1, 2, 3])


@pytest.mark.parametrize("name", sorted(set(POLYTOPES) - {"box", "slab", "pillar"}))
def test_all_forms_differ_as_much_in_their_costs_as_the_cube(name):
    body = POLYTOPES[name]()
    assert body.radius - body.offsets.min() == pytest.approx(np.sqrt(3.0) - 1.0)


def test_links_lead_to_and_fro():
    faces = faces_of([POLYTOPES["dodecahedron"](), POLYTOPES["pyramid"]()])
    near = [set(faces.targets[begin:end]) for begin, end in faces.links]
    for edge, (first, second) in enumerate(faces.edge_ends, faces.edge_start):
        assert len(near[edge]) == 2
        assert all(edge in near[facet] for facet in near[edge])
        assert edge in near[first] and edge in near[second]
        assert faces.shared(first, second) == faces.shared(second, first) == edge
    np.testing.assert_allclose(np.linalg.norm(faces.ways, axis=1), 1.0)


def test_points_give_the_hull_about_their_origin():
    cube = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
    body = from_points(np.concatenate([3.0 * cube, 0.5 * cube]))
    assert (len(body.vertices), len(body.edges), len(body.normals)) == (8, 12, 6)
    np.testing.assert_allclose(np.sort(np.abs(body.vertices), axis=None), 1.0)
    # moved, its sides are at different distances, and facets are not split
    body = from_points(cube + [0.5, 0.0, 0.0])
    assert len(body.normals) == 6
    np.testing.assert_allclose(np.unique((body.offsets / body.offsets.min()).round(6)), [1, 2, 3])


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: from_directions(np.eye(3)), "all sides"),
        (lambda: from_directions([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]), "all sides"),
        (lambda: from_directions(np.zeros((6, 3))), "not zero"),
        (lambda: from_directions([[np.nan, 0, 0]]), "finite"),
        (lambda: from_directions([]), "finite"),
        (lambda: from_points([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]), "flat"),
        (lambda: from_points(np.eye(3)), "four points"),
        (lambda: from_points(shapes.blob(1)[0] + 9.0), "origin"),
    ],
)
def test_refused(make, words):
    with pytest.raises(CubicCraftError, match=words):
        make()


@pytest.mark.parametrize("name", POLYTOPES)
def test_the_areas_of_the_facets_are_those_of_the_hull(name):
    body = POLYTOPES[name]()
    assert body.facet_areas.sum() == pytest.approx(ConvexHull(body.vertices).area)
    assert (body.facet_areas > 0.0).all()


TURN = shapes.rotation(10, 20, 30)


def with_points_inside(corners, count):
    """Return the corners and so many points of their hull."""
    random = np.random.default_rng(4)
    shares = random.dirichlet(np.full(len(corners), 0.3), size=count)
    return np.concatenate([shares @ corners, corners]) @ TURN.T


@pytest.mark.parametrize("name", ["cube", "rounded cube", "octahedron", "dodecahedron", "pyramid"])
@pytest.mark.parametrize("count", [100, MANY_POINTS + 100])
def test_a_body_is_its_own_hull(name, count):
    corners = POLYTOPES[name]().vertices
    found, wanted = simple_hull(with_points_inside(corners, count), 64), from_points(corners)
    assert len(found.normals) == len(wanted.normals)
    nearest = (found.normals @ TURN @ wanted.normals.T).max(axis=1)
    np.testing.assert_allclose(nearest, 1.0, atol=1e-9)
    np.testing.assert_allclose(np.sort(found.offsets), np.sort(wanted.offsets), rtol=1e-6)


@pytest.mark.parametrize("count", [300, 10_000, 100_000])
def test_a_ball_has_few_sides_that_touch_it_soon(count):
    points = np.random.default_rng(5).normal(size=(count, 3)) * [1.0, 0.6, 0.8]
    points /= np.linalg.norm(points / [1.0, 0.6, 0.8], axis=1, keepdims=True)
    begin = time.perf_counter()
    body = simple_hull(points, 64)
    assert time.perf_counter() - begin < 30.0  # every pair of 20,000 triangles takes minutes
    assert 30 <= len(body.normals) <= 64
    reach = (points @ body.normals.T).max(axis=0)
    np.testing.assert_allclose(reach / body.offsets, (reach / body.offsets)[0], rtol=1e-9)


@pytest.mark.parametrize("broken", [np.nan, np.inf])
def test_points_that_are_not_finite_are_refused(broken):
    for count in (100, MANY_POINTS + 100):
        points = np.random.default_rng(6).normal(size=(count, 3))
        points[7, 1] = broken
        with pytest.raises(CubicCraftError, match="four points"):
            simple_hull(points, 64)
