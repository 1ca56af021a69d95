# SPDX-License-Identifier: GPL-3.0-or-later
"""The active set against a tight ADMM, far starts, and problems that have no single answer."""

import numpy as np
import pytest
import shapes
from engine_marks import needs_engine
from tight_admm import TIGHT

from solver import PAPER
from solver.backends import local_step_class
from solver.preparation import rest_mesh
from solver.styles import admm
from solver.styles.active_set import active_set_rotations
from solver.styles.admm import AdmmOptions, admm_rotations
from solver.styles.local_problem import LocalProblem

Q = shapes.rotation(25, -10, 40)


def problem_of(U, rest, lam):
    n = len(rest.V)
    S = rest.matrices.covariances(U) / rest.areas[:, None, None]
    return LocalProblem(S, rest.normals, np.broadcast_to(Q, (n, 3, 3)), np.full(n, lam))


def start(problem):
    R = np.tile(np.eye(3), (len(problem.lam), 1, 1))
    return R, problem.starting(R)


def objective(problem, R):
    fit, cost = problem.costs(R)
    return problem.lam * cost - fit


def deformed(V, amount):
    return V + amount * np.sin(4 * V[:, [1, 2, 0]] + 1.0)


@pytest.mark.parametrize("lam", [0.0, 0.1, 0.4, 1.0])
def test_it_is_as_good_as_a_tight_admm(lam):
    rest = rest_mesh(*shapes.blob(2), proxy=PAPER)
    R, s = start(problem_of(rest.V, rest, lam))
    kinds = set()
    for amount in (0.0, 0.02, 0.05, 0.08):  # a warm start in all but the first
        problem = problem_of(deformed(rest.V, amount), rest, lam)
        reference, _ = admm_rotations(problem, R, s, TIGHT)
        R, s, is_done = active_set_rotations(problem, R, s)
        assert is_done.all()
        best = objective(problem, reference)
        size = np.abs(problem.S).sum(axis=(1, 2))
        assert ((objective(problem, R) - best) / size).max() < 1e-9
        kinds |= set((np.abs(s) < 1.0).sum(axis=1))
    assert kinds == {0.0: {0}, 0.1: {0, 1}}.get(lam, {0, 1, 2})


def test_the_subgradient_certifies_the_minimiser():
    rest = rest_mesh(*shapes.blob(2), proxy=PAPER)
    problem = problem_of(deformed(rest.V, 0.08), rest, 0.4)
    R, s, is_done = active_set_rotations(problem, *start(problem))
    assert is_done.all()
    x = problem.form_normals(R)
    assert (np.abs(s) <= 1.0).all()
    np.testing.assert_allclose((s * x).sum(axis=1), np.abs(x).sum(axis=1), atol=1e-9)
    pull = np.einsum("nji,nj->ni", problem.Q, s) * problem.lam[:, None]
    G = R @ (problem.S - problem.normals[:, :, None] * pull[:, None, :])
    np.testing.assert_allclose(G, G.swapaxes(1, 2), atol=1e-8)  # stationary


def test_a_maximum_is_not_taken_for_a_minimum():
    """After half a turn the energy is stationary, but largest; only rounding leads away."""
    rest = rest_mesh(*shapes.blob(1), proxy=PAPER)
    problem = problem_of(rest.V * [-1, -1, 1], rest, 0.0)
    best = np.tile(np.diag([-1.0, -1, 1]), (len(rest.V), 1, 1))
    R, s, is_done = active_set_rotations(problem, *start(problem))
    assert not is_done.all()
    np.testing.assert_allclose(R[is_done], best[is_done], atol=1e-8)
    R, _ = admm_rotations(problem, R, s, AdmmOptions())
    np.testing.assert_allclose(R, best, atol=1e-8)


def test_the_admm_goes_on_only_where_it_has_not_lowered_the_energy(monkeypatch):
    rest = rest_mesh(*shapes.blob(2), proxy=PAPER)
    problem = problem_of(deformed(rest.V, 0.08), rest, 0.4)
    last, states = start(problem)
    sizes = []
    iteration = admm._iteration

    def spy(problem, *arguments):
        sizes.append(len(problem.lam))
        return iteration(problem, *arguments)

    monkeypatch.setattr(admm, "_iteration", spy)
    exact, _ = admm_rotations(problem, last, states, AdmmOptions(trial=100))
    until, sizes[:] = len(sizes), []
    near, near_states = admm_rotations(problem, last, states, AdmmOptions())
    assert problem.is_better(near, last).all()
    assert len(sizes) < until / 3 and sizes[3] == len(last)
    again = near
    for _ in range(60):
        again, near_states = admm_rotations(problem, again, near_states, AdmmOptions())
    assert (objective(problem, again) - objective(problem, exact)).max() < 1e-4


@needs_engine
@pytest.mark.parametrize("precision", ["f64", "f32"])
@pytest.mark.parametrize("lam", [0.0, 1e-9, 0.4, 5.0, 1e6])
def test_degenerate_shapes_keep_a_rotation_no_worse_than_the_last(lam, precision):
    rest = rest_mesh(*shapes.blob(1), proxy=PAPER)
    V = rest.V
    n = len(V)
    make = local_step_class("cpu", precision)
    step = make(rest, np.full(n, lam), np.tile(Q, (n, 1, 1)), AdmmOptions())
    tolerance = 1e-12 if precision == "f64" else 1e-5
    for U in (V, V * [1, 1, -1], V * [-1, -1, 1], 0 * V, V * [1, 0, 0], V * [1, 1, 0], 50 * V):
        problem = problem_of(U, rest, lam)
        before = objective(problem, step.R.astype(float))
        step.update(U)
        R = step.R.astype(float)
        np.testing.assert_allclose(np.linalg.det(R), 1.0, atol=tolerance)
        scale = lam + np.abs(problem.S).sum(axis=(1, 2)) + 1e-30
        assert ((objective(problem, R) - before) / scale).max() <= tolerance
