# SPDX-License-Identifier: GPL-3.0-or-later
"""The local problem by Newton's method with an active set: exact in one to three steps.

Per vertex, with S divided by the area so that nothing depends on scale or tessellation:

    min over R in SO(3):  -tr(R S) + lam h(x),   x = Q R n,

where h is the support function of a body W, such as |x|_1 for the cube. At a minimiser there is a
subgradient s of h, a point of W with s.x = h(x), with which R is stationary for

    -tr(R (S - lam n (Q's)')),

an orthogonal Procrustes problem. s lies on a face of W: a vertex, an edge whose ends cost the same
at x, or the facet whose normal is x. That hardly changes from one iteration to the next, so it is
stored with R, and each step is one of these (Nocedal and Wright, "Numerical Optimization", 2nd
edition, chapter 18, equality-constrained Newton steps with least-squares multipliers):

- on a facet: the normal is that of the facet, and the best turn about it has a closed form;
- else Newton's step of `rotation_fit`, on an edge with direction c on the tangent of x.c = 0. With
  p the gradient of x.c, K = H + kappa pp' has the same constrained minimiser as H, and where K is
  positive definite it is a minimum. Elsewhere it is shifted until it is, as by Levenberg and
  Marquardt.

Then s goes to the vertex or the edge at which it leaves its edge or facet, and to the edge or facet
whose normals x has passed. Where neither happens and the step was small, R is a certified local
minimiser, up to the square of the step. What is not certified (starts that are far off, degenerate
or mirrored S) is left to the ADMM of `admm.py`.

For the cube the faces are found from s itself: s_k is the sign of x_k, but anything in [-1, 1] on
the active axes, those with x_k = 0, of which a vertex has none, an edge one and a facet two.

Compared with an ADMM with a warm start and a relative tolerance of 1e-5, this takes 1.4 to 3 steps
instead of 6 to 18 Newton steps, and a local step is 2.2 to 2.8 times faster (bunny and armadillo,
cubeness 0.2; horse, 0.4). No objective lies above that of an ADMM with a tolerance of 1e-10 by more
than 2e-12 of its size, where before a quarter to two thirds did so by more than 1e-9. On these
meshes nothing is left to the ADMM.
"""

from dataclasses import dataclass

import numpy as np

from ..algebra import (
    adjugate,
    axial,
    columns,
    determinant,
    from_columns,
    shifted,
    size_squared,
    turn,
)
from ..rotation_fit import MIN_CURVATURE, curvature, is_definite

MAX_STEPS = 20
SMALLEST_TURN = 1e-3
"""of 1 + cos of the angle to the best turn, relative to its sine, below which it is half a turn"""
NEAREST_TARGET = 0.5
"""of 1 + cos of the angle between the normal and the axis that it is turned onto"""


@dataclass(frozen=True)
class Tolerances:
    """What counts as nothing; in 32 bit much is rounding."""

    angle: float
    """radians; the step that is smaller is still applied"""
    slack: float
    """by how much s may leave its face, and x pass what bounds its normals"""
    aligned: float
    """sine of the angle to its axis of a normal with two active axes"""


DOUBLE = Tolerances(angle=1e-5, slack=1e-9, aligned=1e-10)
SINGLE = Tolerances(angle=1e-3, slack=1e-5, aligned=1e-6)


def active_set_rotations(problem, R, states):
    """Return the minimisers near R, in 64 bit; the Taichi kernels do the same step by step.

    Parameters
    ----------
    problem : LocalProblem
    R : (n,3,3) float array
        Rotations to start from.
    states : (n,w) float array
        Subgradients to start from, and what else the form keeps of a vertex.

    Returns
    -------
    R : (n,3,3) float array
    states : (n,w) float array
    is_done : (n,) bool array
        Which are certified; the others are those given.
    """
    result_R, result_states = R.copy(), states.copy()
    is_done = np.zeros(len(R), bool)
    todo = np.arange(len(R))
    kept = problem.form.begin(states)
    G = R @ problem.S
    for _ in range(MAX_STEPS):
        if not len(todo):
            break
        W, is_last, is_good = _step(problem, R, G, kept)
        R, G = W @ R, W @ G
        y = np.einsum("nij,nj->ni", R, problem.normals)
        x = np.einsum("nij,nj->ni", problem.Q, y)
        kept, is_kept = problem.form.next_set(kept, _axial(G), x, y, problem, DOUBLE.slack)
        is_last &= is_kept & is_good
        done = todo[is_last]
        is_done[done] = True
        result_R[done], result_states[done] = R[is_last], problem.form.end(kept)[is_last]
        more = is_good & ~is_last
        todo, problem = todo[more], problem.part(more)
        R, G, kept = R[more], G[more], tuple(values[more] for values in kept)
    return result_R, result_states, is_done


def _step(problem, R, G, kept):
    """Return turns W (n,3,3), which may be the last (n,), and which are sound (n,)."""
    s, number, direction = problem.form.constraints(kept)
    is_facet = number == 2
    q, v = np.ones(len(G)), np.zeros((len(G), 3))
    is_last, is_good = np.zeros(len(G), bool), np.zeros(len(G), bool)
    for rows, step in ((is_facet, _turn_about_axis), (~is_facet, _newton_step)):
        arrays = (values[rows] for values in (R, G, s, number, direction))
        part = step(problem.part(rows), *arrays)
        q[rows], v[rows], is_last[rows], is_good[rows] = part
    q[~is_good], v[~is_good] = 1.0, 0.0
    return _turn(q, v), is_last, is_good


def _turn_about_axis(problem, R, G, _s, _number, direction):
    """Put the normal on its axis t; once it is there, turn about it."""
    y = np.einsum("nij,nj->ni", R, problem.normals)
    t = _from_form(problem.Q, direction)
    v = np.cross(y, t)
    q = 1.0 + _dot(y, t)
    is_good = q > NEAREST_TARGET
    is_last = is_good & (_dot(v, v) < DOUBLE.aligned**2)
    along = np.trace(G, axis1=1, axis2=2) - np.einsum("ni,nij,nj->n", t, G, t)
    across = _dot(_axial(G), t)
    best = along + np.sqrt(along * along + across * across)
    q = np.where(is_last, best, q)
    v = np.where(is_last[:, None], across[:, None] * t, v)
    is_good &= ~is_last | (best > SMALLEST_TURN * np.abs(across))
    return q, v, is_last, is_good


def _newton_step(problem, R, G, s, number, direction):
    """Take Newton's step, on the tangent of x.direction = 0 on an edge."""
    normals, Q, lam = problem.normals, problem.Q, problem.lam
    y = np.einsum("nij,nj->ni", R, normals)
    L = G - y[:, :, None] * (lam[:, None] * _from_form(Q, s))[:, None, :]
    h = np.trace(L, axis1=1, axis2=2)
    p = np.cross(y, _from_form(Q, direction.astype(float)))
    kappa = number * (np.abs(h) + lam)
    K = curvature_on_tangent(kappa, *columns(L), *p.T)
    is_sound = is_definite(MIN_CURVATURE, *K, *adjugate(*K))
    K = shifted(np.where(is_sound, 0.0, np.sqrt(size_squared(*K))), *K)
    inverse = adjugate(*K)
    divisor = determinant(*K, *inverse)
    is_zero = divisor == 0.0  # without any force
    inverse = (np.array(inverse) / np.where(is_zero, 1.0, divisor)).reshape(3, 3, -1)
    w, r = (np.einsum("ijn,nj->ni", inverse, v) for v in (_axial(L), p))
    is_one = ~is_zero & (number == 1)
    x = np.einsum("nij,nj->ni", Q, y)
    excess = (_dot(p, w) + _dot(x, direction)) / np.where(is_one, _dot(p, r), 1.0)
    w -= np.where(is_one, excess, 0.0)[:, None] * r
    is_small = _dot(w, w) <= DOUBLE.angle**2
    return np.ones(len(G)), 0.5 * w, is_sound & is_small, is_sound | ~is_small


def curvature_on_tangent(kappa, *entries):
    """Return K = H + kappa pp' for L and p, in the entries of `algebra.py`."""
    x, y, z = entries[9:]
    d, e, f = kappa * x * y, kappa * x * z, kappa * y * z
    squares = (kappa * (x * x), d, e, d, kappa * (y * y), f, e, f, kappa * (z * z))
    return [h + square for h, square in zip(curvature(*entries[:9]), squares, strict=True)]


def _turn(q, v):
    """Return the rotations (n,3,3) of the quaternions (q, v), of any length."""
    return from_columns(turn(2.0 / (q * q + _dot(v, v)), q, *v.T))


def _axial(G):
    return from_columns(axial(*columns(G)))


def _from_form(Q, x):
    return np.einsum("nji,nj->ni", Q, x)


def _dot(a, b):
    return (a * b).sum(axis=1)
