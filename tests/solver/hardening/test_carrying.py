# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes along as sides become flat."""

import numpy as np
from proxy_shapes import uv_sphere

from solver import rest_mesh
from solver.hardening.carrying import carried, giving_way, together


def body_with_knob():
    """Return the RestMesh of a ball in which a small one is stuck, and which vertices are of it."""
    V, F = uv_sphere(24, 12)
    V, F = np.concatenate([V, 0.2 * V + [0.0, -1.0, 0.0]]), np.concatenate([F, F + len(V)])
    rest = rest_mesh(V, F)
    part = rest.topology.part
    return rest, part != part[np.abs(rest.V - rest.V.min(axis=0)).sum(axis=1).argmin()]


def test_the_lighter_part_goes_along_as_a_whole():
    rest, is_knob = body_with_knob()
    front = rest.V[:, 1] < rest.V[is_knob, 1].max()
    moves = np.where((front & ~is_knob)[:, None], [0.0, 0.1, 0.0], 0.0)
    along = carried(rest, moves, np.empty(0, int))
    assert np.ptp(along[is_knob], axis=0).max() == 0.0
    assert 0.08 < along[is_knob, 1].mean() < 0.11
    assert np.abs(along[~is_knob]).max() < 0.01


def test_what_is_fixed_stays_and_takes_the_other_part_along():
    rest, is_knob = body_with_knob()
    moves = np.where(is_knob[:, None], 0.0, [0.0, 0.1, 0.0])
    along = carried(rest, moves, np.flatnonzero(is_knob)[:1])
    assert np.abs(along[is_knob]).max() < 1e-3


def test_two_parts_that_would_cross_go_as_one_and_folds_stay():
    U = np.random.default_rng(0).random((200, 3))
    moves = 0.1 + U * [0.1, 0.0, 0.0]
    F, part = np.arange(12).reshape(4, 3), np.zeros(200, int)
    part[:3] = 1
    pairs = np.array([[0, 1], [2, 3]])
    along = together(U, F, pairs, moves, part, np.ones(200, bool), np.zeros((2, 2), bool))
    two, fold = F.reshape(2, 6)  # which share no corner
    np.testing.assert_allclose(along[two], np.tile(moves[two].mean(axis=0), (6, 1)))
    assert not along[fold].any()
    rest = along[12:, 0] / along[two[0], 0]
    assert rest.min() > 0.0 and rest.max() < 1.0 and np.ptp(rest) > 0.5
    is_near = np.linalg.norm(U[12:, None] - U[two], axis=2).min(axis=1) < 0.1
    assert rest[is_near].mean() > rest.mean() + 0.1


def test_what_is_much_lighter_goes_as_the_place_that_it_would_cross():
    """A candle bent the cake that it stands on: it gives way now, until nothing but that helps."""
    U = np.array(
        [[0.0, 0, 0], [2, 0, 0], [0, 2, 0], [0.5, 0.5, 0.1], [0.6, 0.5, 0.1], [0.5, 0.7, 0]]
    )
    moves = np.zeros((6, 3))
    moves[1, 2] = 0.4
    F, part, pairs = np.arange(6).reshape(2, 3), np.repeat([0, 1], 3), np.array([[0, 1]])
    gives_way = giving_way(part[F[pairs, 0]], np.array([2.0, 0.1]), np.empty((0, 2), int))
    assert gives_way.tolist() == [[False, True]]
    along = together(U, F, pairs, moves, part, np.ones(6, bool), gives_way)
    np.testing.assert_allclose(along[:3], moves[:3])
    np.testing.assert_allclose(along[3:, 2], [0.1, 0.12, 0.1])
    assert not giving_way(part[F[pairs, 0]], np.array([2.0, 1.0]), np.empty((0, 2), int)).any()
    assert not giving_way(part[F[pairs, 0]], np.array([2.0, 0.1]), np.array([[1, 0]])).any()
