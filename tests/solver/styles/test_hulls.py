# SPDX-License-Identifier: GPL-3.0-or-later
"""The hull of many points: exact where it has few sides, with few sides everywhere."""

import time

import numpy as np
import pytest
import shapes
from named_forms import POLYTOPES

from solver import CubicCraftError
from solver.styles.hulls import MANY_POINTS, simple_hull
from solver.styles.polytope import from_points

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
