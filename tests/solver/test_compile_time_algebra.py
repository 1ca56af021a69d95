# SPDX-License-Identifier: GPL-3.0-or-later
"""The algebra on entries agrees with NumPy's on arrays."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from solver.backends import compile_time_algebra as algebra


@pytest.fixture
def matrices():
    return np.random.default_rng(1).normal(size=(2, 3, 3))


@pytest.fixture
def vectors():
    return np.random.default_rng(2).normal(size=(2, 3))


def entries(*arrays):
    return [value for array in arrays for value in array.ravel()]


def test_products_of_vectors(vectors):
    a, b = vectors
    assert_allclose(algebra.dot(*a, *b), [a @ b])
    assert_allclose(algebra.cross(*a, *b), np.cross(a, b))
    assert_allclose(algebra.outer(*a, *b), np.outer(a, b).ravel())
    assert_allclose(algebra.total(*a), [a.sum()])


def test_products_with_matrices(matrices, vectors):
    A, B = matrices
    v = vectors[0]
    assert_allclose(algebra.product(*entries(A, B)), (A @ B).ravel())
    assert_allclose(algebra.gram(*entries(A)), (A.T @ A).ravel())
    assert_allclose(algebra.times(*entries(A, v)), A @ v)
    assert_allclose(algebra.transposed_times(*entries(A, v)), A.T @ v)
    assert_allclose(algebra.trace(*entries(A)), [np.trace(A)])


def test_the_axial_vector_is_that_of_the_skew_part(matrices, vectors):
    A, v = matrices[0], vectors[0]
    axial = algebra.axial(*entries(A))
    assert_allclose(np.cross(axial, v), (A.T - A) @ v)


def test_a_turn_is_the_rotation_of_its_quaternion():
    q, v = 0.9, np.array([0.3, -0.5, 0.7])
    W = np.reshape(algebra.turn(2 / (q * q + v @ v), q, *v), (3, 3))
    assert_allclose(W @ W.T, np.eye(3), atol=1e-15)
    assert_allclose(W @ v, v)
    half_angle = np.arctan2(np.linalg.norm(v), q)
    assert_allclose(np.trace(W), 1 + 2 * np.cos(2 * half_angle))
    across = np.cross(v, [1.0, 0.0, 0.0])
    assert np.cross(across, W @ across) @ v > 0  # it turns the right way
