# SPDX-License-Identifier: GPL-3.0-or-later
"""What would cross as sides become flat: which of two gives way, and where it goes."""

import numpy as np
from hard_surfaces import chest

from solver import PAPER, rest_mesh
from solver.hardening.giving_way import Bodies, together
from solver.mesh.polygons import triangulate


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
    along = together(U, F, pairs, moves, part, np.ones(6, bool), np.array([[False, True]]))
    np.testing.assert_allclose(along[:3], moves[:3])
    np.testing.assert_allclose(along[3:, 2], [0.1, 0.12, 0.1])


def test_the_lighter_of_two_parts_or_of_two_sides_gives_way_until_that_does_not_help():
    V, quads = chest()
    F = triangulate(V, quads)
    V, F = np.concatenate([V, 0.1 * V - 1.0]), np.concatenate([F, F + len(V)])
    rest = rest_mesh(V, F, PAPER)
    graph, height = rest.face_graph, V[F, 2].mean(axis=1)
    side = 2 * np.abs(graph.normals).argmax(axis=1) + (graph.normals.sum(axis=1) > 0.0)
    is_top, is_ledge = ((side == way) & np.isclose(height, at) for way, at in ((5, 0.0), (4, -0.2)))
    bodies = Bodies(rest, graph, side)
    top, ledge, knob = (np.flatnonzero(which)[0] for which in (is_top, is_ledge, height < -1.0))
    of_pairs = bodies.of_pairs(np.array([[top, ledge], [top, knob], [knob, ledge]]))
    gives_way = bodies.giving_way(of_pairs, np.empty((0, 2), int))
    assert gives_way.tolist() == [[False, True], [False, True], [True, False]]
    assert not bodies.giving_way(of_pairs, of_pairs[:, ::-1]).any()
    assert (np.flatnonzero(bodies.vertices(of_pairs[0, :1])) == np.unique(F[is_top])).all()
    assert (np.flatnonzero(bodies.vertices(of_pairs[1, :1])) == np.unique(F[height > -1.0])).all()
