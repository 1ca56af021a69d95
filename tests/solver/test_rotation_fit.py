# SPDX-License-Identifier: GPL-3.0-or-later
"""Newton's rotation fit against the singular value decomposition."""

import numpy as np
import pytest

from solver.rotation_fit import fit_rotations, orthonormalize, svd_rotations

RANDOM = np.random.default_rng(1)


def random_rotations(n):
    Q, _ = np.linalg.qr(RANDOM.normal(size=(n, 3, 3)))
    return Q * np.sign(np.linalg.det(Q))[:, None, None]


def assert_rotations(R, tolerance=1e-12):
    np.testing.assert_allclose(
        R @ R.swapaxes(1, 2), np.tile(np.eye(3), (len(R), 1, 1)), atol=tolerance
    )
    np.testing.assert_allclose(np.linalg.det(R), 1.0, atol=tolerance)


def trace_of(R, M):
    return np.einsum("nij,nji->n", R, M)


CASES = {
    "random": RANDOM.normal(size=(2000, 3, 3)),
    "rank 1": RANDOM.normal(size=(500, 3, 1)) * RANDOM.normal(size=(500, 1, 3)),
    "rank 2": np.einsum("nik,nkj->nij", *RANDOM.normal(size=(2, 500, 3, 3))) * [[[1], [1], [0]]],
    "reflected": -random_rotations(500) * np.array([3.0, 2.0, 1.0]),
    "zero": np.zeros((3, 3, 3)),
    "tiny": 1e-12 * RANDOM.normal(size=(100, 3, 3)),
    "huge": 1e12 * RANDOM.normal(size=(100, 3, 3)),
}


@pytest.mark.parametrize("case", CASES)
def test_fit_is_a_rotation_and_as_good_as_the_svd(case):
    M = CASES[case]
    best = svd_rotations(M)
    assert_rotations(best)
    for guess in (np.tile(np.eye(3), (len(M), 1, 1)), random_rotations(len(M))):
        R = fit_rotations(M, guess)
        assert_rotations(R)
        size = np.abs(M).sum(axis=(1, 2)) + 1e-300
        assert ((trace_of(best, M) - trace_of(R, M)) / size).max() < 1e-12


@pytest.mark.parametrize("count", [0, 50, 5000])
def test_orthonormalize_takes_rounding_away(count):
    exact = random_rotations(count)
    R = orthonormalize(exact + 1e-7 * RANDOM.normal(size=exact.shape))
    assert_rotations(R)
    np.testing.assert_allclose(R, exact, atol=1e-6)


def test_orthonormalize_finds_the_nearest_rotation_in_steps():
    R = random_rotations(100) + 0.1 * RANDOM.normal(size=(100, 3, 3))
    nearest = svd_rotations(R.swapaxes(1, 2))  # the greatest tr(X R')
    np.testing.assert_allclose(orthonormalize(R, 6), nearest, atol=1e-12)
