# SPDX-License-Identifier: GPL-3.0-or-later
"""The global step: minimal energy, exact pins, centroids that stay, and both factorisations."""

import numpy as np
import psutil
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg
import shapes
import threadpoolctl
from optional_marks import needs

from solver import PAPER, CubicCraftError, Setup
from solver.global_step import factorization
from solver.global_step.step import Centring, GlobalStep
from solver.mesh.rest_measures import cotangents
from solver.mesh.spokes_and_rims import spokes_and_rims
from solver.optional_packages import optional_package
from solver.surface.preparation import rest_mesh

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


@pytest.mark.parametrize("floats", [[True, False], [False, True], [True, True]])
def test_only_what_floats_is_moved(floats):
    rest = rest_mesh(*shapes.two_blobs(), proxy=PAPER)
    floats = np.array(floats)
    moved = rest.V + np.array([[0.1, 0.0, 0.0], [0.0, 0.2, 0.3]])[rest.topology.component]
    result = moved.copy()
    Centring(rest, floats).impose(result)
    is_back = floats[rest.topology.component]
    np.testing.assert_allclose(result[is_back], rest.V[is_back], atol=1e-12)
    np.testing.assert_array_equal(result[~is_back], moved[~is_back])


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
