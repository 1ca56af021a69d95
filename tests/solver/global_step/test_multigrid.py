# SPDX-License-Identifier: GPL-3.0-or-later
"""Multigrid stands in for the factorisation: the same positions, after more iterations."""

import numpy as np
import pytest
import shapes
from engine_marks import needs_engine
from optional_marks import needs

from solver import PAPER, Setup, rest_mesh, stylize
from solver.backends.arrays import HostArrays
from solver.backends.taichi_cycle import _LEAST as LEAST
from solver.backends.taichi_cycle import TaichiCycle, chebyshev_weights
from solver.backends.taichi_runtime import start
from solver.global_step import step as module
from solver.global_step.multigrid import Multigrid

pytestmark = needs("pyamg")

SHAPES = {
    "blob": lambda: shapes.blob(4),
    "skewed_blob": shapes.skewed_blob,
    "sheet": lambda: shapes.sheet(40),
    "two_blobs": shapes.two_blobs,
    "broken": shapes.broken,
}


def laplacian(V, F):
    rest = rest_mesh(V, F, PAPER)
    L = rest.matrices.matrix(rest.matrices.laplacian)
    _, first = np.unique(rest.topology.component, return_index=True)
    is_held = np.zeros(len(rest.V), bool)
    is_held[first] = True
    return L, is_held


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("coarsest", [20, 2000])
def test_cycles_converge_to_the_solution(name, coarsest, monkeypatch):
    monkeypatch.setattr("solver.global_step.multigrid._COARSEST", coarsest)
    L, is_held = laplacian(*SHAPES[name]())
    exact = np.random.default_rng(1).normal(size=(len(is_held), 3))
    solver = Multigrid(L, module.decoupled(L, is_held), np.flatnonzero(is_held))
    X = np.where(is_held[:, None], exact, 0.0)
    errors = []
    for _ in range(40):
        X = solver.solve(L @ exact, X)
        error = X - exact
        errors.append(np.sqrt((error * (L @ error)).sum()))
    np.testing.assert_array_equal(X[is_held], exact[is_held])
    falling = np.array(errors) > 1e-6 * errors[0]  # below it is rounding, on bad triangles
    assert (np.diff(errors)[falling[1:]] < 0.0).all()  # as descent needs it
    # Triangles without area leave two vertices all but rigidly tied, which smoothing does not see.
    assert errors[-1] < (0.5 if name == "broken" else 1e-3) * errors[0]


@needs_engine
def test_two_cycles_leave_less_and_never_go_too_far(monkeypatch):
    # Descent needs a matrix above the Laplacian: X B, the square of X by that matrix, is no less
    # than its square by the Laplacian.
    monkeypatch.setattr("solver.global_step.multigrid._COARSEST", 20)
    L, is_held = laplacian(*shapes.blob(4))
    start("cpu")
    multigrid = Multigrid(L, module.decoupled(L, is_held), np.flatnonzero(is_held))
    A = multigrid.levels[0].A.astype(float)
    left = []
    for cycles in (1, 2):
        cycle = TaichiCycle(multigrid, HostArrays(), cycles)
        error = np.random.default_rng(2).normal(size=(len(is_held), 3))
        for _ in range(30):
            cycle.B[: len(error), :3] = B = A @ (error / np.linalg.norm(error))
            cycle.run()
            X = cycle.X[: len(B), :3].astype(float)
            assert (X * B).sum() >= (X * (A @ X)).sum() * (1 - 1e-5)
            error = error / np.linalg.norm(error) - X
        left.append(np.linalg.norm(error))  # of what is left longest
    assert left[1] < left[0] ** 2


@pytest.mark.thorough(2)
@pytest.mark.parametrize("pins", [0, 15])
def test_it_ends_where_the_factorisation_does(pins, monkeypatch, device):
    V, F = shapes.blob()
    pinned = np.argsort(V[:, 2])[:pins]
    exact = stylize(V, F, 0.4, pinned, device=device, tolerance=1e-5, proxy=PAPER)
    monkeypatch.setattr(module, "FACTORIZED_VERTICES", 0)
    monkeypatch.setattr("solver.global_step.multigrid._COARSEST", 20)
    near = stylize(V, F, 0.4, pinned, device=device, tolerance=1e-5, proxy=PAPER)
    again = stylize(V, F, 0.4, pinned, device=device, tolerance=1e-5, proxy=PAPER)
    assert near.converged
    assert near.energy.total == pytest.approx(exact.energy.total, rel=1e-5)
    assert np.abs(near.positions - exact.positions).max() < 5e-3
    np.testing.assert_array_equal(near.positions[pinned], V[pinned])
    np.testing.assert_array_equal(near.positions, again.positions)


def test_without_the_package_all_is_factorised(monkeypatch):
    monkeypatch.setattr(module, "FACTORIZED_VERTICES", 0)
    monkeypatch.setattr("solver.global_step.multigrid.optional_package", lambda name: None)
    rest = rest_mesh(*shapes.blob(), proxy=PAPER)
    solve = Setup(rest).global_step.positions
    L = rest.matrices.matrix(rest.matrices.laplacian)
    np.testing.assert_allclose(solve(L @ rest.V, np.zeros_like(rest.V)), rest.V, atol=1e-9)


def test_many_small_parts_have_nothing_coarser_than_one_row(monkeypatch, device):
    monkeypatch.setattr("solver.global_step.multigrid._COARSEST", 20)
    V, F = shapes.sphere(1)
    count = 40
    W = np.concatenate([V + [3.0 * k, 0.0, 0.0] for k in range(count)])
    G = np.concatenate([F + len(V) * k for k in range(count)])
    exact = stylize(W, G, 0.4, device=device, tolerance=1e-4, proxy=PAPER)
    monkeypatch.setattr(module, "FACTORIZED_VERTICES", 0)
    near = stylize(W, G, 0.4, device=device, tolerance=1e-4, proxy=PAPER)
    levels = Setup(rest_mesh(W, G, PAPER)).global_step.multigrid.levels
    assert levels[-1].P.shape[1] == 1 and not levels[-1].P.nnz
    assert near.converged
    assert near.energy.total == pytest.approx(exact.energy.total, rel=1e-4)


@pytest.mark.parametrize("cycles", [2, 4])
def test_no_part_of_the_error_is_corrected_by_more_than_it_is_but_nearly(cycles):
    weights, factor = chebyshev_weights(cycles)
    part = np.linspace(LEAST, 1.0, 1000)  # to which a cycle times the matrix takes it
    corrected = factor * (1.0 - np.prod(1.0 - weights * part[:, None], axis=1))
    assert corrected.max() == pytest.approx(1.0, abs=1e-5)
