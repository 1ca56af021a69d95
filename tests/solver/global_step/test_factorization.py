# SPDX-License-Identifier: GPL-3.0-or-later
"""Both factorisations against a dense solve."""

import numpy as np
import psutil
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg
import shapes
import threadpoolctl
from optional_marks import needs

from solver.global_step import factorization
from solver.mesh.cotangents import cotangents
from solver.mesh.spokes_and_rims import spokes_and_rims
from solver.optional_packages import optional_package


@pytest.mark.parametrize("use_cholespy", [False, pytest.param(True, marks=needs("cholespy"))])
def test_solve_matches_a_dense_solve(use_cholespy, monkeypatch):
    if not use_cholespy:
        monkeypatch.setattr(factorization, "optional_package", lambda name: None)
    V, F = shapes.skewed_blob()
    m = spokes_and_rims(V, F, cotangents(V, F))
    A = sp.csr_matrix(m.matrix(m.laplacian)[1:, 1:])
    B = np.random.default_rng(2).normal(size=(len(V) - 1, 3))
    solve = factorization.factorize(A)
    X = solve(B)
    np.testing.assert_allclose(X, np.linalg.solve(A.toarray(), B), rtol=1e-7, atol=1e-8)
    np.testing.assert_array_equal(X, solve(B))


def test_a_broken_cholespy_is_done_without(monkeypatch):
    broken = {"cholespy": factorization}
    monkeypatch.setattr(factorization, "optional_package", broken.get)
    A = sp.csr_matrix(np.diag([1.0, 2.0, 4.0]))
    np.testing.assert_allclose(factorization.factorize(A)(np.eye(3)), np.diag([1.0, 0.5, 0.25]))


def test_scipy_factorises_with_one_thread(monkeypatch):
    seen, splu = [], scipy.sparse.linalg.splu

    def watched(*arguments, **options):
        seen.append(threads_of_blas())
        return splu(*arguments, **options)

    monkeypatch.setattr(scipy.sparse.linalg, "splu", watched)
    packages = {"threadpoolctl": threadpoolctl}
    monkeypatch.setattr(factorization, "optional_package", packages.get)
    with threadpoolctl.threadpool_limits(2, user_api="blas"):
        factorization.factorize(sp.identity(3, format="csr"))
        assert (seen, threads_of_blas()) == ([{1}], {2})


def threads_of_blas():
    return {
        info["num_threads"]
        for info in threadpoolctl.threadpool_info()
        if info["user_api"] == "blas"
    }


def test_a_folder_left_behind_is_no_package(tmp_path, monkeypatch):
    (tmp_path / "of_a_package_that_is_gone").mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    assert optional_package("of_a_package_that_is_gone") is None


@needs("cholespy")
def test_nothing_is_left_of_a_factorisation():
    n, rounds = 5000, 300
    A = sp.diags([-np.ones(n - 1), 3.0 * np.ones(n), -np.ones(n - 1)], [-1, 0, 1]).tocsr()
    B = np.ones((n, 3))

    def factorize_and_solve(times):
        for _ in range(times):
            factorization.factorize(A)(B)

    factorization.factorize(A)  # and never solve
    factorize_and_solve(50)
    process = psutil.Process()
    before = process.memory_info().rss
    factorize_and_solve(rounds)
    assert process.memory_info().rss - before < rounds * B.nbytes / 3
