# SPDX-License-Identifier: GPL-3.0-or-later
"""The algebra on entries is that of NumPy's own arrays, on columns of NumPy and in a kernel."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial.transform import Rotation

from solver import algebra
from solver.backends.engine import import_engine
from solver.backends.taichi_runtime import start
from solver.rotation_fit import MIN_CURVATURE, curvature, is_definite
from solver.styles.active_set import curvature_on_tangent

COUNT = 50
RANDOM = np.random.default_rng(1)
A, B = RANDOM.normal(size=(2, COUNT, 3, 3))
SYMMETRIC = A + A.swapaxes(1, 2)
a, b = RANDOM.normal(size=(2, COUNT, 3))
IDENTITY = np.eye(3)


@pytest.mark.parametrize("count", [0, 1, algebra.BLOCK, 2 * algebra.BLOCK + 7])
def test_rows_in_blocks_are_those_at_once(count):
    x, y = RANDOM.normal(size=(count, 3, 2)), RANDOM.normal(size=count)

    def scaled(x, y):
        return x * y[:, None, None]

    assert_array_equal(algebra.by_blocks(scaled, x, y), scaled(x, y))


def listed(result):
    return result if isinstance(result, list) else [result]


def on_columns(function, entries):
    return np.stack(listed(function(*entries.T)), axis=1)


def in_a_kernel(function, entries, device):
    ti = import_engine()
    start(device)
    real = ti.f64 if device == "cpu" else ti.f32
    result = on_columns(function, entries)
    given, found = (ti.types.vector(values.shape[1], real) for values in (entries, result))

    def as_list(*operands):
        return listed(function(*operands))

    @ti.kernel
    def call(
        X: ti.types.ndarray(dtype=given, ndim=1),  # pyright: ignore[reportInvalidTypeForm]
        Y: ti.types.ndarray(dtype=found, ndim=1),  # pyright: ignore[reportInvalidTypeForm]
    ):
        for i in range(X.shape[0]):
            operands = X[i]
            Y[i] = found(ti.static(as_list(*operands)))

    kind = np.float64 if device == "cpu" else np.float32
    result = np.zeros(result.shape, kind)
    call(entries.astype(kind), result)
    return result


@pytest.fixture
def check(device):
    """Return a function that compares one of entries with what it has to be."""

    def compare(function, operands, expected):
        entries = np.concatenate([part.reshape(COUNT, -1) for part in operands], axis=1)
        if device == "numpy":
            result = on_columns(function, entries)
        else:
            result = in_a_kernel(function, entries, device)
        expected = np.reshape(expected, (COUNT, -1))
        assert_allclose(result, expected, atol=1e-4 if device == "gpu" else 1e-12)

    return compare


def test_columns_are_put_together_as_they_were():
    assert_array_equal(algebra.from_columns(list(algebra.columns(A))), A)
    assert_array_equal(algebra.from_columns(list(a.T)), a)
    nothing = A[:0]
    assert algebra.from_columns(list(algebra.columns(nothing))).shape == nothing.shape


@pytest.mark.parametrize("values", [A, a, a[:, 0]], ids=["matrices", "vectors", "numbers"])
def test_rows_are_taken_and_put_wherever_they_lie(values):
    rows = np.array([3, 0, 4])
    kept = algebra.by_columns(values)
    assert algebra.columns(kept).flags.c_contiguous and not np.shares_memory(kept, values)
    for source in (values, kept):
        assert_array_equal(algebra.take(source, rows), values[rows])
    algebra.put(kept, rows, values[rows[::-1]])
    expected = values.copy()
    expected[rows] = values[rows[::-1]]
    assert_array_equal(kept, expected)


def test_products_of_vectors(check):
    check(algebra.dot, [a, b], (a * b).sum(axis=1))
    check(algebra.cross, [a, b], np.cross(a, b))
    check(algebra.outer, [a, b], a[:, :, None] * b[:, None, :])
    check(algebra.total, [a], a.sum(axis=1))


def test_products_with_matrices(check):
    transposed = A.swapaxes(1, 2)
    check(algebra.product, [A, B], A @ B)
    check(algebra.gram, [A], transposed @ A)
    check(algebra.times, [A, b], A @ b[:, :, None])
    check(algebra.transposed_times, [A, b], transposed @ b[:, :, None])
    check(algebra.trace, [A], np.trace(A, axis1=1, axis2=2))


def test_the_axial_vector_is_that_of_the_skew_part(check):
    def applied(*entries):
        return algebra.cross(*algebra.axial(*entries[:9]), *entries[9:])

    check(applied, [A, b], (A.swapaxes(1, 2) - A) @ b[:, :, None])


def test_axial_vectors_and_the_turns_of_vectors_are_products_with_one_matrix():
    axial = np.stack(algebra.axial(*A.reshape(-1, 9).T), axis=1)
    np.testing.assert_allclose(A.reshape(-1, 9) @ algebra.AXIAL, axial)
    turns = (b @ algebra.AXIAL.T).reshape(-1, 3, 3)
    np.testing.assert_allclose(turns, np.cross(b[:, None], np.eye(3)))


def test_symmetric_matrices_are_inverted_by_their_adjugates(check):
    def inverted(*entries):
        adjugate = algebra.adjugate(*entries)
        return algebra.product(*entries, *adjugate)

    def determinant(*entries):
        return algebra.determinant(*entries, *algebra.adjugate(*entries))

    determinants = np.linalg.det(SYMMETRIC)
    check(inverted, [SYMMETRIC], determinants[:, None, None] * IDENTITY)
    check(determinant, [SYMMETRIC], determinants)
    check(algebra.size_squared, [SYMMETRIC], (SYMMETRIC**2).sum(axis=(1, 2)))
    check(algebra.shifted, [a[:, :1], SYMMETRIC], SYMMETRIC + a[:, :1, None] * IDENTITY)


def test_a_turn_is_the_rotation_of_its_quaternion(check):
    quaternions = np.concatenate([a, b[:, :1]], axis=1)  # SciPy has the scalar last
    scale = 2 / (quaternions**2).sum(axis=1)
    check(algebra.turn, [scale, b[:, 0], a], Rotation.from_quat(quaternions).as_matrix())


def test_a_step_of_newton_and_schulz(check):
    check(algebra.nearer_to_orthogonal, [A], 1.5 * A - 0.5 * A @ A.swapaxes(1, 2) @ A)


def test_the_curvature_is_the_second_derivative_of_the_fit(check):
    H = np.trace(A, axis1=1, axis2=2)[:, None, None] * IDENTITY - (A + A.swapaxes(1, 2)) / 2
    check(curvature, [A], H)
    kappa = b[:, :1]
    tangent = H + kappa[:, :, None] * a[:, :, None] * a[:, None, :]
    check(curvature_on_tangent, [kappa, A, a], tangent)


def test_definite_is_what_has_positive_eigenvalues_only(check):
    def decided(least, *entries):
        return is_definite(least, *entries, *algebra.adjugate(*entries))

    shifts = np.linspace(-1.0, 6.0, COUNT)[:, None, None]
    shifted = SYMMETRIC + shifts * IDENTITY
    lowest = np.linalg.eigvalsh(shifted)[:, 0]
    assert 0 < np.count_nonzero(lowest > 0) < COUNT
    check(decided, [np.full(COUNT, MIN_CURVATURE), shifted], lowest > 0)
    almost_singular = IDENTITY * [[1.0, 1.0, 2 * MIN_CURVATURE]] + np.zeros((COUNT, 1, 1))
    check(decided, [np.full(COUNT, MIN_CURVATURE), almost_singular], np.ones(COUNT))
    check(decided, [np.full(COUNT, 10 * MIN_CURVATURE), almost_singular], np.zeros(COUNT))
