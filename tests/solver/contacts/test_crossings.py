# SPDX-License-Identifier: GPL-3.0-or-later
"""Crossings: all are found and nothing else, which of them are seen, and how they come apart."""

import numpy as np
import pytest
import shapes
from proxy_shapes import joined, uv_sphere
from scipy.sparse.csgraph import shortest_path

from solver.contacts import push
from solver.contacts.crossings import CrossingTriangles, Watched, boxes, crossings
from solver.contacts.gaps import NEAR_EDGES, Gaps, graph_of
from solver.contacts.shown import shown
from solver.mesh import overlaps
from solver.mesh.rest_measures import areas_and_normals


def soup(count, size, spread=0.3, seed=0):
    """Return triangles of different size without common vertices."""
    rng = np.random.default_rng(seed)
    sizes = size * rng.lognormal(0.0, spread, (count, 1, 1))
    corners = rng.random((count, 1, 3)) + sizes * rng.normal(size=(count, 3, 3))
    return corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def by_all_edges(V, F):
    """Return the pairs of which an edge of one goes through the other, from all pairs."""
    i, j = np.triu_indices(len(F), 1)
    is_apart = ~(F[i][:, :, None] == F[j][:, None, :]).any(axis=(1, 2))
    i, j = i[is_apart], j[is_apart]
    A, B = V[F[i]], V[F[j]]
    is_crossing = np.zeros(len(i), dtype=bool)
    for k in range(3):
        is_crossing |= goes_through(A[:, k], A[:, k - 1], B) | goes_through(B[:, k], B[:, k - 1], A)
    return np.stack([i[is_crossing], j[is_crossing]], axis=1)


def goes_through(P, Q, T):
    a, b, c = T[:, 0], T[:, 1], T[:, 2]
    normal = np.cross(b - a, c - a)
    p, q = ((normal * (end - a)).sum(axis=1) for end in (P, Q))
    is_cut = p * q < 0.0
    X = P + (p / np.where(is_cut, p - q, 1.0))[:, None] * (Q - P)
    for u, v in ((a, b), (b, c), (c, a)):
        is_cut &= (np.cross(v - u, X - u) * normal).sum(axis=1) > 0.0
    return is_cut


@pytest.mark.parametrize(
    ("count", "size", "spread"), [(2, 0.5, 0.3), (300, 0.1, 0.3), (800, 0.03, 0.3), (600, 0.05, 2)]
)
def test_a_soup_has_the_crossings_that_its_edges_have(count, size, spread):
    V, F = soup(count, size, spread)
    np.testing.assert_array_equal(crossings(V, F), by_all_edges(V, F))


def test_what_is_watched_has_the_crossings_that_a_new_search_finds():
    V, F = soup(800, 0.05)
    rng = np.random.default_rng(1)
    is_moved = rng.random(len(F)) < 0.3
    (low, high), margin = boxes(V, F), 0.02 * is_moved[:, None]
    watched = Watched(F, low - margin, high + margin, is_moved)
    moves = rng.uniform(-0.02, 0.02, V.shape) * np.repeat(is_moved, 3)[:, None]
    for share in (1.0, 0.2):  # what stays where it is between two calls is not looked at again
        moves = np.where(rng.random((len(V), 1)) < share, moves * rng.random((len(V), 1)), moves)
        found = np.sort(watched.crossings(V + moves), axis=1)
        expected = crossings(V + moves, F)
        expected = expected[is_moved[expected].any(axis=1)]
        assert len(expected) > 50
        np.testing.assert_array_equal(found[np.lexsort(found.T[::-1])], expected)


@pytest.mark.parametrize("share", [0.0, 0.01, 0.3])
@pytest.mark.parametrize("spread", [0.02, 0.6])
def test_some_triangles_have_the_crossings_that_all_have(share, spread):
    V, F = soup(800, spread)
    F = np.concatenate([F, [[0, 4, 8]]])  # a large one
    is_asked = np.random.default_rng(2).random(len(F)) < share
    expected = crossings(V, F)
    np.testing.assert_array_equal(
        crossings(V, F, is_asked), expected[is_asked[expected].any(axis=1)]
    )


def test_which_triangles_cross_is_found_where_it_is_asked_for():
    V, F = soup(800, 0.05)
    is_crossing = np.zeros(len(F), dtype=bool)
    is_crossing[crossings(V, F).ravel()] = True
    crosses = CrossingTriangles(V, F)
    for triangles in np.random.default_rng(3).integers(len(F), size=(5, 40, 2)):
        np.testing.assert_array_equal(crosses(triangles), is_crossing[triangles])
    assert 0 < is_crossing.sum() < len(F)


@pytest.mark.parametrize(
    "other",
    [
        [(0.2, 0.2, 0.0), (0.2, 0.2, 1.0), (0.3, 0.2, 1.0)],  # stands on it
        [(0.1, 0.1, 0.0), (0.4, 0.1, 0.0), (0.1, 0.4, 0.0)],  # lies in it
        [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)],  # is the same
        [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 0.5)],  # meets it in an edge
        [(0.2, 0.2, -1.0), (0.2, 0.2, 1.0), (0.2, 0.2, 1.0)],  # has no area
        [(2.0, 0.0, -1.0), (2.0, 0.0, 1.0), (2.0, 1.0, 1.0)],  # is elsewhere
        [(0.2, 0.2, -1e-9), (0.2, 0.2, 1.0), (0.3, 0.2, 1.0)],  # goes in less than rounding
    ],
)
def test_what_touches_does_not_cross(other):
    V = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), *other], dtype=float)
    assert len(crossings(V, np.arange(6).reshape(2, 3))) == 0


def test_a_needle_crosses_a_plate_of_a_thousand_times_its_size():
    V, F = shapes.sheet(30)
    needle = np.array([(0.41, 0.52, -1.0), (0.4101, 0.52, -1.0), (0.41, 0.5201, 1.0)])
    found = crossings(np.concatenate([V, needle]), np.concatenate([F, [[900, 901, 902]]]))
    assert len(found) == 1 and found[0, 1] == len(F)


def test_what_shares_a_vertex_is_no_pair():
    V = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.3, 0.3, 1), (0.3, 0.3, -1)], dtype=float)
    assert len(crossings(V, np.array([[0, 1, 2], [0, 3, 4]]))) == 0


def test_nothing_is_raised_for_what_is_no_surface():
    nothing = np.empty((0, 3))
    assert len(crossings(nothing, nothing.astype(int))) == 0
    V, F = soup(50, 0.2)
    for part in (F[:0], F[:1], np.repeat(F[:1], 100, axis=0), F[:, [0, 0, 0]]):
        assert len(crossings(V, part)) == 0
    assert len(crossings(V * 0.0, F)) == 0
    found = crossings(V, F)
    V[0] = np.nan
    without = crossings(V, F)
    np.testing.assert_array_equal(without, found[(found != 0).all(axis=1)])


def test_of_many_that_lie_on_top_of_each_other_no_pair_is_compared(monkeypatch):
    monkeypatch.setattr(overlaps, "MOST", 100)
    V, F = soup(1, 0.5)
    assert len(crossings(V, np.repeat(F, 500, axis=0))) == 0


def fold(degrees, size=25):
    """Return a flat sheet of edge 0.5 that is folded in its middle to an angle."""
    V, F = shapes.sheet(size)
    x, y = 0.5 * V[:, 0] - 0.25, 0.5 * V[:, 1]
    half = np.radians(degrees / 2)
    return np.stack([np.abs(x) * np.cos(half), y, x * np.sin(half)], axis=1), F


def test_no_link_leads_to_a_vertex_nearby_on_the_surface():
    V, F = fold(30.0)
    i, j = Gaps(V, areas_and_normals(V, F)[1], F).partners(np.arange(len(V)))
    edges = shortest_path(graph_of(F, len(V)), unweighted=True)[i, j]
    assert len(i) > 100 and edges.min() > NEAR_EDGES
    assert (V[i, 2] * V[j, 2] < 0.0).all(), "from one side of the fold to the other"


@pytest.mark.parametrize(("normal", "is_gap"), [((0, 0, -1), True), ((1, 0, 0), False)])
def test_a_gap_faces_both_of_its_ends(normal, is_gap):
    """What stands on a floor faces it from the floor only."""
    V = np.array([[0.0, 0, 0], [0, 0, 0.05]])
    gaps = Gaps(V, np.array([[0.0, 0, 1], normal]), np.empty((0, 3), int))
    assert bool(len(gaps.partners(np.array([0]))[0])) == is_gap


def test_what_is_asked_again_is_answered_as_before_without_a_search(monkeypatch):
    V, F = fold(30.0)
    gaps = Gaps(V, areas_and_normals(V, F)[1], F)
    some = np.arange(0, len(V), 3)
    gaps.partners(some)
    i, j = gaps.partners(np.arange(len(V)))
    anew = Gaps(V, areas_and_normals(V, F)[1], F).partners(np.arange(len(V)))
    np.testing.assert_array_equal((i, j), anew)
    searches = []
    monkeypatch.setattr(gaps, "_across", lambda *asked: searches.append(asked))
    np.testing.assert_array_equal(gaps.partners(some), (i[np.isin(i, some)], j[np.isin(i, some)]))
    assert not searches


@pytest.fixture
def steps(monkeypatch):
    """Return positions after each step, of which the second has fewer crossings than the others."""
    V, F = shapes.blob(1)
    pairs = np.array([[0, 40], [1, 41], [2, 42]])
    left = iter([pairs[:2], pairs[:1], *[pairs] * push.STEPS])

    class Watched:
        def __init__(self, *_):
            pass

        def crossings(self, _):
            return next(left)

    monkeypatch.setattr(push, "Watched", Watched)
    seen = []

    def impose(U):
        U += 1e-4 * (len(seen) + 1)
        seen.append(U.copy())

    counts, is_free = lambda pairs: np.ones(len(pairs), bool), np.ones(len(V), bool)
    best = push.pushed(V, V + 0.0, F, pairs, counts, is_free, impose)
    return seen, best


def test_the_best_step_counts_not_the_last(steps):
    seen, best = steps
    assert len(seen) == push.STEPS
    np.testing.assert_array_equal(best, seen[1])
    assert np.abs(best - seen[-1]).max() > 0.0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_where_the_rest_shape_says_nothing_the_shorter_way_leads_apart(sign):
    over = [(1, 1, 0.3 * sign), (2, 1, -0.1 * sign), (1, 2, -0.1 * sign)]
    V = np.array([*over, (0, 0, 0), (9, 0, 0), (0, 9, 0)], dtype=float)
    _, lift, _ = push._lifts(V, V, np.array([[0, 1, 2]]), np.array([[3, 4, 5]]))
    np.testing.assert_allclose(lift, sign * np.array([[0.0, 0.1, 0.1]]), atol=2 * push.MARGIN)


def test_many_that_do_not_come_apart_are_given_up_soon(monkeypatch):
    """Of a heap of coins, 4,000 pairs crossed after 15 steps, and after 40."""
    V, F = shapes.blob(2)
    pairs = np.array([[k, k + 160] for k in range(push.MANY + 20)])
    steps = []

    class Watched:
        def __init__(self, *_):
            pass

        def crossings(self, _):
            steps.append(len(pairs))
            return pairs

    monkeypatch.setattr(push, "Watched", Watched)
    counts, is_free = lambda pairs: np.ones(len(pairs), bool), np.ones(len(V), bool)
    push.pushed(V, V + 0.0, F, pairs, counts, is_free, lambda _: None)
    assert len(steps) == push.PATIENCE


def cross(at):
    """Return two small triangles that cross each other at a place."""
    V = np.array([[-1.0, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0.1, 1], [0, -1, 1]])
    return 0.1 * V + at, np.array([[0, 1, 2], [3, 4, 5]])


def test_what_is_inside_is_not_seen():
    V, F = joined(uv_sphere(24, 12), cross([0.1, 0.2, 0.0]), cross([2.0, 0.3, 0.1]))
    pairs = crossings(V, F)
    count = len(uv_sphere(24, 12)[1])
    assert pairs.tolist() == [[count, count + 1], [count + 2, count + 3]]
    assert shown(V, F, pairs).tolist() == [False, True]


def test_a_line_on_the_outside_is_seen():
    """Where two balls go into each other, a line goes around both."""
    V, F = uv_sphere(24, 12)
    V, F = joined((V, F), (V * 0.9 + [0.7, 0.05, 0.02], F))
    assert shown(V, F, crossings(V, F)).all()


def test_nothing_crosses():
    V, F = uv_sphere(8, 4)
    assert shown(V, F, np.empty((0, 2), int)).shape == (0,)
