# SPDX-License-Identifier: GPL-3.0-or-later
"""The active set against a tight ADMM, far starts, and problems that have no single answer."""

import numpy as np
import pytest
import shapes
from engine_marks import needs_engine
from local_problems import Q, active_set_beside_admm, blob, deformed, objective, problem_of

from solver import PAPER
from solver.backends import local_step_class
from solver.styles import admm
from solver.styles.active_set import active_set_rotations
from solver.styles.admm import AdmmOptions, admm_rotations
from solver.surface.preparation import rest_mesh


def start(problem):
    R = np.tile(np.eye(3), (len(problem.lam), 1, 1))
    return R, problem.starting(R)


@pytest.mark.parametrize("lam", [0.0, 0.1, 0.4, 1.0])
def test_it_is_as_good_as_a_tight_admm(lam):
    rest = blob()
    states, uncertified = active_set_beside_admm(
        lambda amount: problem_of(deformed(rest.V, amount), rest, lam), (0.0, 0.02, 0.05, 0.08)
    )
    assert not uncertified
    kinds = {kind for s in states for kind in (np.abs(s) < 1.0).sum(axis=1)}
    assert kinds == {0.0: {0}, 0.1: {0, 1}}.get(lam, {0, 1, 2})


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
    rest = blob()
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
