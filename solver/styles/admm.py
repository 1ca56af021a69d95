# SPDX-License-Identifier: GPL-3.0-or-later
"""The local problem by the alternating direction method of multipliers (ADMM): from any start.

Per vertex, and divided by its area a_i so that nothing depends on scale or tessellation:

    min over R in SO(3):  -tr(R S_i / a_i) + lam_i h(Q R n_i)

is split by z = Q R n_i. The step in z is a projection onto the body whose support function h is,
and what it projects to is the subgradient (Moreau's decomposition; for the cube, this is soft
thresholding). The rest is in sections 3.1.1, 3.3.1 and 3.4.1 of Boyd et al., "Distributed
Optimization and Statistical Learning via the Alternating Direction Method of Multipliers", 2011.
It solves what `active_set.py` cannot certify.
"""

from dataclasses import dataclass

import numpy as np

from ..rotation_fit import fit_rotations


@dataclass(frozen=True)
class AdmmOptions:
    """Tolerances and penalty of the ADMM. Penalties are in units of the vertex area."""

    max_iterations: int = 25
    trial: int = 4
    """iterations after which a rotation will do that is better than the one before: the next local
    step goes on from there, and by then the others have moved"""
    absolute: float = 1e-7
    """absolute part of the tolerance of either residual"""
    relative: float = 1e-5
    """relative part of the tolerance of either residual"""
    rho_start: float = 2.0
    rho_min: float = 1e-2
    rho_max: float = 1e3
    balance: float = 10.0
    """mu: how far apart the residuals may be before the penalty changes"""
    factor: float = 2.0
    """tau: by how much the penalty then changes"""


def admm_rotations(problem, R, states, options):
    """Return rotations and states that minimize the local energy near R.

    `problem`, `R`, `states`: as in `active_set.active_set_rotations`. `options`: AdmmOptions.
    Returns `R`: (n,3,3); `states`: (n,w).
    """
    last, R, states = R, R.copy(), states.copy()
    plain = problem.lam == 0.0
    R[plain] = fit_rotations(problem.S[plain], R[plain])
    todo = np.flatnonzero(~plain)
    problem = problem.part(todo)
    rho = np.full(len(todo), options.rho_start)
    z = problem.form.split(problem.form_normals(R[todo]), states[todo])
    u = states[todo, :3] * (problem.lam / rho)[:, None]
    for number in range(options.max_iterations):
        if not len(todo):
            break
        R[todo], z, u, states[todo], is_done, rho_new = _iteration(
            problem, R[todo], z, u, rho, options
        )
        u *= (rho / rho_new)[:, None]
        if number + 1 >= options.trial:
            is_done |= problem.is_better(R[todo], last[todo])
        more = np.flatnonzero(~is_done)
        todo, problem = todo[more], problem.part(more)
        z, u, rho = z[more], u[more], rho_new[more]
    return R, states


def _iteration(problem, R, z, u, rho, o):
    pull = np.einsum("nji,nj->ni", problem.Q, z - u) * rho[:, None]
    R = fit_rotations(problem.S + problem.normals[:, :, None] * pull[:, None, :], R)
    x = problem.form_normals(R)
    threshold = (problem.lam / rho)[:, None]
    states = problem.form.project((x + u) / threshold)
    u_new = threshold * states[:, :3]
    z_new = x + u - u_new
    primal = np.linalg.norm(z_new - x, axis=1)
    dual = rho * np.linalg.norm(z_new - z, axis=1)
    size = np.maximum(np.linalg.norm(x, axis=1), np.linalg.norm(z_new, axis=1))
    force = rho * np.linalg.norm(u_new, axis=1)
    is_done = (primal <= o.absolute + o.relative * size) & (dual <= o.absolute + o.relative * force)
    change = np.ones(len(rho))
    change[primal > o.balance * dual] = o.factor
    change[dual > o.balance * primal] = 1.0 / o.factor
    return R, z_new, u_new, states, is_done, np.clip(rho * change, o.rho_min, o.rho_max)
