# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons of any shape become triangles that cover them, and use all corners."""

import numpy as np
import pytest

from cubic_craft.mesh.polygons import MANY, triangulate

TURN = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]


def star(size, seed):
    """Return a star-shaped, in general concave polygon (size,2), counter-clockwise."""
    random = np.random.default_rng(seed)
    angles = np.sort(random.uniform(0, 2 * np.pi, size))
    angles = 2 * np.pi * (np.arange(size) + 0.8 * (angles - angles.min()) / 7) / size
    return random.uniform(0.1, 1.0, size)[:, None] * np.stack([np.cos(angles), np.sin(angles)], 1)


def comb(teeth):
    """Return a polygon that no corner sees all of."""
    x = np.arange(teeth)
    top = [point for i in x for point in ((i + 0.1, 1.0), (i + 0.2, 0.1), (i + 1.0, 0.1))]
    return np.array([(0.0, 0.0), (float(teeth), 0.0), *top[::-1]])


def on_straight_edges(count):
    """Return an L whose six edges have so many corners each."""
    ends = np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], float)
    t = np.arange(count)[:, None] / count
    return np.concatenate(
        [a + t * (b - a) for a, b in zip(ends, np.roll(ends, -1, 0), strict=True)]
    )


SHAPES = {
    **{f"star {size}, {seed}": star(size, seed) for size in (4, 5, 7, 20) for seed in range(5)},
    "regular": np.stack([np.cos(np.arange(9) * 0.698), np.sin(np.arange(9) * 0.698)], 1),
    "arrow": np.array([(0, 0), (2, 1), (0, 2), (0.7, 1)], float),
    "arrow from its notch": np.array([(0.7, 1), (0, 0), (2, 1), (0, 2)], float),
    "corners on straight edges": np.array(
        [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)], float
    ),
    "a slit to a hole": np.array(
        [(0, 0), (3, 0), (3, 3), (0, 3), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)], float
    ),
    "comb": comb(6),
    "comb of many teeth": comb(MANY),
    "star of many": star(2 * MANY, 0),
    "many corners on straight edges": on_straight_edges(MANY),
}


def area(points):
    """Return the signed area of a polygon (s,2)."""
    (x, y), (after_x, after_y) = points.T, np.roll(points, -1, axis=0).T
    return 0.5 * (x * after_y - y * after_x).sum()


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("is_reversed", [False, True])
def test_triangles_cover_the_polygon(name, is_reversed):
    flat = SHAPES[name][::-1] if is_reversed else SHAPES[name]
    size = len(flat)
    V = np.concatenate([flat, np.zeros((size, 1))], axis=1) @ TURN.T + [3.0, -2.0, 5.0]
    corners = np.random.default_rng(size).permutation(size)
    shuffled = np.empty_like(V)
    shuffled[corners] = V  # so that corners and vertices have different numbers
    triangles = triangulate(shuffled, corners[None])
    assert triangles.shape == (size - 2, 3)
    assert set(triangles.ravel()) == set(range(size))
    position = np.empty(size, int)
    position[corners] = np.arange(size)
    areas = np.array([area(flat[position[triangle]]) for triangle in triangles])
    sign = np.sign(area(flat))
    assert (sign * areas > -1e-9).all()  # none is turned over
    assert sign * areas.sum() == pytest.approx(sign * area(flat))


def test_corners_on_long_straight_edges_are_joined_across():
    """Triangles between neighbours on an edge have no area, and hold none of them."""
    flat = on_straight_edges(MANY)
    V = np.concatenate([flat, np.zeros((len(flat), 1))], axis=1)
    triangles = triangulate(V, np.arange(len(flat))[None])
    areas = np.array([area(flat[triangle]) for triangle in triangles])
    assert set(triangles[areas > 1e-6].ravel()) == set(range(len(flat)))


def test_many_corners_take_no_longer_than_their_number():
    """With their square it would be minutes."""
    angles = 2 * np.pi * np.arange(60_000) / 60_000
    radii = 1 + 0.3 * np.sin(9 * angles)
    flat = radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    V = np.concatenate([flat, np.zeros((len(flat), 1))], axis=1)
    triangles = triangulate(V, np.arange(len(flat))[None])
    a, b, c = (flat[triangles[:, corner]] for corner in range(3))
    doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert doubled.sum() == pytest.approx(2 * area(flat)) and doubled.min() > -1e-9


def test_triangles_stay_and_what_is_less_is_none():
    V = np.zeros((4, 3))
    assert np.array_equal(triangulate(V, np.array([[2, 0, 1]])), [[2, 0, 1]])
    assert triangulate(V, np.array([[0, 1]])).shape == (0, 3)


@pytest.mark.parametrize(
    "points", [np.zeros((6, 3)), np.arange(18.0).reshape(6, 3), np.eye(6)[:, :3]]
)
def test_degenerate_polygons_use_all_corners(points):
    triangles = triangulate(points, np.arange(6)[None])
    assert triangles.shape == (4, 3) and set(triangles.ravel()) == set(range(6))
