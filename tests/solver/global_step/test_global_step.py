# SPDX-License-Identifier: GPL-3.0-or-later
"""The global step: minimal energy, exact pins, centroids that stay."""

import numpy as np
import pytest
import shapes

from solver import PAPER, CubicCraftError, Setup
from solver.global_step.step import GlobalStep
from solver.preparation import rest_mesh

NO_PINS = np.array([], int)


def rotated_rhs(rest):
    """Return a right-hand side of rotations that vary over the mesh."""
    m = rest.matrices
    angles = 30 * np.sin(5 * rest.V)
    R = np.stack([shapes.rotation(*a) for a in angles])
    return sum(m.matrix(m.scatter[:, c]) @ R[:, :, c] for c in range(3)) / 3


def test_result_solves_the_normal_equations():
    rest = rest_mesh(*shapes.two_blobs(), proxy=PAPER)
    rhs = rotated_rhs(rest)
    U = GlobalStep(rest, NO_PINS).positions(rhs, rest.V)
    L = rest.matrices.matrix(rest.matrices.laplacian)
    np.testing.assert_allclose(L @ U, rhs, atol=1e-11)


def test_centroids_of_free_components_stay():
    rest = rest_mesh(*shapes.two_blobs(), proxy=PAPER)
    U = GlobalStep(rest, NO_PINS).positions(rotated_rhs(rest), rest.V)
    for label in range(rest.topology.component_count):
        part = rest.topology.component == label
        weights = rest.areas[part]
        before, after = (np.average(X[part], axis=0, weights=weights) for X in (rest.V, U))
        np.testing.assert_allclose(after, before, atol=1e-12)


@pytest.mark.parametrize("make", [shapes.two_blobs, lambda: shapes.blob(2)])
def test_free_components_do_not_turn_where_their_rotation_is_kept(make):
    rest = rest_mesh(*make(), proxy=PAPER)
    tilted = rest.V @ shapes.rotation(10, 20, 5)
    step = GlobalStep(rest, NO_PINS)
    rhs = rest.matrices.matrix(rest.matrices.laplacian) @ tilted
    for keep_rotation in (False, True):
        U = step.positions(rhs, rest.V, keep_rotation)
        for label in range(rest.topology.component_count):
            part = rest.topology.component == label
            weights = rest.standing[part]
            x, u = (X[part] - np.average(X[part], axis=0, weights=weights) for X in (rest.V, U))
            torque = np.average(np.cross(x, u), axis=0, weights=weights)
            assert (float(np.abs(torque).max()) < 1e-12) is keep_rotation


def test_pinned_vertices_keep_their_bits_and_their_component_is_not_centred():
    rest = rest_mesh(*shapes.two_blobs(), proxy=PAPER)
    pins = np.array([0, 5, 17])
    start = rest.V.copy()
    start[pins] += [0.1, 0.2, 0.3]
    U = GlobalStep(rest, pins).positions(rotated_rhs(rest), start)
    np.testing.assert_array_equal(U[pins], start[pins])
    L = rest.matrices.matrix(rest.matrices.laplacian)
    free = np.setdiff1d(np.arange(len(rest.V)), pins)
    np.testing.assert_allclose((L @ U)[free], rotated_rhs(rest)[free], atol=1e-11)


def test_everything_pinned_is_refused():
    rest = rest_mesh(*shapes.blob(1), proxy=PAPER)
    with pytest.raises(CubicCraftError, match="all vertices are pinned"):
        Setup(rest, np.arange(len(rest.V)))
