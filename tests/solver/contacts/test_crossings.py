# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles that cross: all of them are found, and nothing else."""

import numpy as np
import pytest
import shapes

from solver.contacts.crossings import CrossingTriangles, Watched, crossings
from solver.mesh import overlaps


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
    watched = Watched(V, F, is_moved, 0.02, lambda pairs: np.ones(len(pairs), dtype=bool))
    moves = rng.uniform(-0.02, 0.02, V.shape) * np.repeat(is_moved, 3)[:, None]
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
