# SPDX-License-Identifier: GPL-3.0-or-later
"""Few planar polygons in place of the sides of a shape: closed, planar, straight, and near it."""

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from shapes import blob, extent, rotation, sheet, squares

from solver import PAPER, low_poly, stylize
from solver.facets.joining import crowded, joined, straightened, without_needless
from solver.facets.polygons import crossings

SIDES = np.concatenate([np.eye(3), -np.eye(3)])


def edges_of(polygons):
    return [edge for loop in polygons for edge in pairwise([*loop, loop[0]])]


def off_plane(V, loop):
    X = V[loop] - V[loop].mean(axis=0)
    return np.abs(X @ np.linalg.svd(X, full_matrices=False)[2][-1]).max()


def rounded_box(n=16, seed=0):
    """Return a box of side 1 with rounded edges and noise."""
    V, F = squares(n)
    inner = np.clip(V, -0.45, 0.45)
    away = V - inner
    V = inner + 0.05 * away / np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-9)
    return V + np.random.default_rng(seed).uniform(-0.002, 0.002, V.shape), F


def test_a_rounded_box_becomes_six_squares():
    V, F = rounded_box()
    made = low_poly(V, F, SIDES, 0.06)
    assert len(made.polygons) == 6 and {len(loop) for loop in made.polygons} == {4}
    assert len({v for loop in made.polygons for v in loop}) == 8
    edges = Counter(edges_of(made.polygons))
    assert set(edges.values()) == {1} and all((b, a) in edges for a, b in edges)  # closed
    assert max(off_plane(made.positions, loop) for loop in made.polygons) < 1e-12
    corners = made.positions[sorted({v for loop in made.polygons for v in loop})]
    np.testing.assert_allclose(np.abs(corners), 0.5, atol=0.005)


@pytest.mark.parametrize("seed", range(3))
def test_a_crisp_blob_becomes_few_planar_polygons(seed):
    V, F = blob(4)
    V = V @ rotation(10 * seed, 20 * seed, 5).T
    U = stylize(V, F, cubeness=0.6, crispness=1.0, detail_strength=0.0, proxy=PAPER).positions
    size = extent(U)
    made = low_poly(U, F, SIDES, 0.02 * size)
    assert len(made.polygons) < 0.06 * len(F)
    assert max(map(len, made.polygons)) <= 64
    assert all(len(set(loop)) == len(loop) >= 3 for loop in made.polygons)
    edges = Counter(edges_of(made.polygons))
    assert set(edges.values()) == {1} and all((b, a) in edges for a, b in edges)
    assert max(off_plane(made.positions, loop) for loop in made.polygons) < 5e-4 * size
    moves = np.linalg.norm(made.positions - U, axis=1)
    assert 0.0 < moves.max() <= 0.02 * size * (1 + 1e-9)


def test_the_eyes_of_a_head_stay_boxes():
    V, F = rounded_box()
    eye, sides = rounded_box(6, seed=1)
    eye = 0.04 * eye + [0.53, 0.2, 0.2]
    head, size = np.concatenate([V, eye]), extent(V)
    made = low_poly(head, np.concatenate([F, len(V) + sides]), SIDES, 0.02 * size)
    loops = [loop for loop in made.polygons if min(loop) >= len(V)]
    assert len(loops) == 6 and {len(loop) for loop in loops} == {4}
    corners = made.positions[sorted({v for loop in loops for v in loop})]
    np.testing.assert_allclose(np.abs(corners - [0.53, 0.2, 0.2]), 0.02, atol=0.002)


@pytest.mark.parametrize("by, most", [(0.02, 80), (0.05, 180)])
def test_sides_that_bulge_are_cut_where_planes_meet(by, most):
    V, F = rounded_box(24)
    waves = np.cos(np.pi * V)
    for axis, (a, b) in enumerate([(1, 2), (2, 0), (0, 1)]):
        out = np.sign(V[:, axis]) * by * waves[:, a] * waves[:, b]
        V[:, axis] += np.where(np.abs(V[:, axis]) > 0.42, out, 0.0)
    size = extent(V)
    made = low_poly(V, F, SIDES, 0.02 * size)
    assert len(made.polygons) < most
    edges = edges_of(made.polygons)
    assert len(set(edges)) == len(edges) and {edge[::-1] for edge in edges} == set(edges)
    assert max(off_plane(made.positions, loop) for loop in made.polygons) < 5e-4 * size
    assert straightness(made) < 1e-3 * size
    assert distances(V, made).max() < 0.015 * size


def straightness(made):
    """Return how far a corner between two polygons is from the line between those beside it."""
    own = {edge: k for k, loop in enumerate(made.polygons) for edge in edges_of([loop])}
    worst = 0.0
    for loop in made.polygons:
        for a, v, b in zip([loop[-1], *loop], loop, [*loop[1:], loop[0]], strict=False):
            if own[v, a] == own[b, v]:
                p, q = made.positions[v] - made.positions[a], made.positions[b] - made.positions[a]
                worst = max(worst, np.linalg.norm(np.cross(p, q)) / np.linalg.norm(q))
    return worst


def distances(points, made):
    """Return how far points (n,3) are from the polygons, convex ones or nearly."""
    found = np.full(len(points), np.inf)
    for loop in made.polygons:
        for b, c in pairwise(loop[1:]):
            found = np.minimum(found, to_triangle(points, *made.positions[[loop[0], b, c]]))
    return found


def to_triangle(points, *corners):
    """Return the distances (n,) of points to a triangle."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    normal = normal / max(np.linalg.norm(normal), 1e-30)
    edges, is_inside = [], np.ones(len(points), bool)
    for p, q in pairwise([*corners, corners[0]]):
        away, along = points - p, q - p
        is_inside &= away @ np.cross(normal, along) >= 0.0
        t = np.clip(away @ along / max(along @ along, 1e-30), 0.0, 1.0)
        edges.append(np.linalg.norm(away - t[:, None] * along, axis=1))
    return np.where(is_inside, np.abs((points - corners[0]) @ normal), np.min(edges, axis=0))


def test_corners_without_room_become_one_and_needless_ones_go():
    W = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [2, 0.01, 0]], float)
    loops = {0: [[0, 1, 2, 5, 3, 4]], 1: [[2, 1, 0, 6, 7]], 2: [[3, 5, 2, 7, 8]]}
    W = np.concatenate([W, [[0, 0, -2], [2, 0, -2], [2, 2, -2]]])
    made, is_changed = without_needless(W, loops, 1e-6)
    assert is_changed and made == {0: [[0, 2, 3, 4]], 1: [[2, 0, 6, 7]], 2: [[3, 2, 7, 8]]}
    made = {0: [[0, 2, 5, 3, 4]], 1: [[2, 0, 6, 7]], 2: [[3, 5, 2, 7, 8]]}
    P = np.where(np.arange(len(W))[:, None] == 5, [2.0, -0.02, 0.0], W)
    assert crowded(W, P, made)[0] == [2, 5]
    made, is_changed = joined(W, made, [[2, 5]])
    assert is_changed and made == {0: [[0, 2, 3, 4]], 1: [[2, 0, 6, 7]], 2: [[3, 2, 7, 8]]}
    assert joined(W, made, [[0, 3]])[1] is False  # far apart
    P = np.where(np.arange(len(W))[:, None] == 2, [3.0, 1.0, 0.0], W)
    assert crossings(P, made[0], np.array([0.0, 0, 1])) == []
    P = np.where(np.arange(len(W))[:, None] == 3, [-1.0, 1.0, 0.0], W)
    assert crossings(P, made[0], np.array([0.0, 0, 1])) == [[[2, 3], [4, 0]]]


def test_charts_and_holes_part_sides():
    V, F = sheet(9)
    V = V * [1.0, 1.0, 0.0]
    x, y = V[F].mean(axis=1)[:, :2].T / V[:, :2].max()
    is_hole = (np.abs(x - 0.5) < 0.13) & (np.abs(y - 0.5) < 0.13)
    made = low_poly(V, F, SIDES, 0.1, charts=is_hole.astype(int))
    assert sorted(Counter(made.part_of).values()) == [1, 2]  # a ring is two polygons
    frame = low_poly(V, F[~is_hole], SIDES, 0.1)
    assert len(frame.polygons) == 2
    used = {v for loop in frame.polygons for v in loop}
    assert len(used) == 8


def test_no_polygon_bridges_a_cut_that_ends_inside():
    V, F = sheet(9)
    V = V * [1.0, 1.0, 0.0] / V[:, :2].max()
    V[:, 0] -= 0.5
    centers = V[F].mean(axis=1)
    is_slit = centers[:, 1] > 0.5  # from the middle to the border, and straight
    near = np.linalg.norm(centers[:, None] - centers, axis=2) < 0.2
    sides = np.sign(centers[:, 0])
    cuts = np.argwhere(near & is_slit & is_slit[:, None] & (sides[:, None] < sides))
    whole, cut = (low_poly(V, F, SIDES, 0.1, cuts=some) for some in (cuts[:0], cuts))
    assert len(whole.polygons) == 1 < len(cut.polygons)
    assert not (cut.parts[cuts[:, 0]] == cut.parts[cuts[:, 1]]).any()
    for loop in cut.polygons:
        x, y, _ = cut.positions[loop].T
        assert y.max() <= 0.6 or x.min() > -0.01 or x.max() < 0.01


def test_vertices_at_one_place_are_one():
    V, F = rounded_box(8)
    apart = low_poly(V[F.ravel()], np.arange(F.size).reshape(-1, 3), SIDES, 0.1)
    together = low_poly(V, F, SIDES, 0.1)
    assert len(apart.polygons) == len(together.polygons) == 6
    assert all((b, a) in edges_of(apart.polygons) for a, b in edges_of(apart.polygons))


CORNERS = np.array([[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [1.3, 1], [1, 2]], float)
HALVES = [[0, 4, 5, 6, 3], [4, 1, 2, 6, 5]]
"""of a square, with a border between them that takes a turn"""


def bent(*, by=0.0):
    """Return the corners of both halves, the one at the turn as much above the others."""
    return np.column_stack([CORNERS, np.where(np.arange(7) == 5, by, 0.0)])


def test_a_border_in_a_plane_is_straight():
    far = [7, 8, 9]
    P = np.concatenate([bent(), [[5, 0, 0], [6, 0, 0], [5, 1, 0]]])
    made, kept = straightened(P, [*HALVES, far], [0, 0, 0], 1e-4)
    assert made == [[0, 4, 6, 3], [4, 1, 2, 6], far] and kept == [0, 1, 2]


@pytest.mark.parametrize("charts, by", [([0, 1], 0.0), ([0, 0], 0.5)])
def test_a_corner_that_materials_or_the_shape_ask_for_stays(charts, by):
    loops = HALVES if by == 0.0 else [[0, 4, 5], [0, 5, 6, 3], [4, 1, 2, 6, 5]]
    chart_of = charts if by == 0.0 else [0, 0, 0]
    assert straightened(bent(by=by), loops, chart_of, 1e-4)[0] == loops


def test_a_triangle_in_the_plane_of_its_neighbor_goes():
    loops = [[0, 4, 6, 3], [4, 5, 6], [4, 1, 2, 6, 5]]
    made, kept = straightened(bent(), loops, [0, 0, 0], 1e-4)
    assert kept in ([0, 2], [0, 1]) and [0, 4, 6, 3] in made
    edges = Counter(edges_of(made))
    assert set(edges.values()) == {1} and len({v for loop in made for v in loop}) == 6
