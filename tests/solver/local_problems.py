# SPDX-License-Identifier: GPL-3.0-or-later
"""Local problems of a blob, and the active set beside an ADMM that goes to its very end."""

import numpy as np
import shapes
from scipy.spatial.transform import Rotation

from solver import PAPER, rest_mesh
from solver.styles.active_set import active_set_rotations
from solver.styles.admm import AdmmOptions, admm_rotations
from solver.styles.cube import CUBE
from solver.styles.local_problem import LocalProblem
from solver.styles.polytope_step import polytopes

TIGHT = AdmmOptions(max_iterations=3000, trial=3000, absolute=1e-13, relative=1e-11)
Q = shapes.rotation(25, -10, 40)


def blob():
    return rest_mesh(*shapes.blob(2), proxy=PAPER)


def deformed(V, amount=0.08):
    return V + amount * np.sin(4 * V[:, [1, 2, 0]] + 1.0)


def problem_of(U, rest, lam, form=None):
    """Return the LocalProblem of a RestMesh at positions U (n,3), with a Polytope or the cube."""
    n = len(rest.V)
    body = CUBE if form is None else polytopes([form], np.zeros(n, int))
    S = rest.matrices.covariances(U) / rest.areas[:, None, None]
    return LocalProblem(S, rest.normals, np.broadcast_to(Q, (n, 3, 3)), np.full(n, lam), body)


def objective(problem, R):
    fit, cost = problem.costs(R)
    return problem.lam * cost - fit


def active_set_beside_admm(problem_at, amounts=(0.0, 0.02, 0.05)):
    """Return the states after each amount of deformation, and how many rows were not certified.

    What is certified must be as good as what the tight ADMM finds from the same warm start.
    """
    problem = problem_at(0.0)
    R, found, uncertified = np.tile(np.eye(3), (len(problem.lam), 1, 1)), [], 0
    states = problem.starting(R)
    for amount in amounts:
        problem = problem_at(amount)
        reference, _ = admm_rotations(problem, R, states, TIGHT)
        R, states, is_done = active_set_rotations(problem, R, states)
        worse = objective(problem, R) - objective(problem, reference)
        assert (worse / np.abs(problem.S).sum(axis=(1, 2)))[is_done].max() < 1e-9
        found.append(states.copy())
        rows = np.flatnonzero(~is_done)
        uncertified += len(rows)
        R[rows], states[rows] = admm_rotations(problem.part(rows), R[rows], states[rows], TIGHT)
    return found, uncertified


def check_random_starts(problem, objective, seed):
    """Check that of as many starts as rows, which are one problem, the best is as good as any."""
    starts = Rotation.random(len(problem.lam), random_state=seed).as_matrix()
    best, _ = admm_rotations(problem, starts, problem.starting(starts), TIGHT)
    R, _, is_done = active_set_rotations(problem, starts, problem.starting(starts))
    assert is_done.any()
    assert objective(R)[is_done].min() <= objective(best).min() + 1e-9
    return R
