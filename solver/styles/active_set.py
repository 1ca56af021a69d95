# SPDX-License-Identifier: GPL-3.0-or-later
"""The local problem by Newton's method with an active set: exact in one to three steps.

Per vertex, with S divided by the area so that nothing depends on scale or tessellation:

    min over R in SO(3):  -tr(R S) + lam |x|_1,   x = Q R n.

At a minimiser there is a subgradient s of |x|_1: s_k is the sign of x_k, but anything in [-1, 1] on
the active axes, those with x_k = 0. With it R is stationary for

    -tr(R (S - lam n (Q's)')),

an orthogonal Procrustes problem. What is active hardly changes from one iteration to the next, so
s is stored with R, and each step is one of these (Nocedal and Wright, "Numerical Optimization",
2nd edition, chapter 18, equality-constrained Newton steps with least-squares multipliers):

- two active axes: the normal lies on the third, and the best turn about it has a closed form;
- one or none: Newton's step of `rotation_fit`, on the tangent of x_k = 0. With p the gradient of
  x_k, K = H + kappa pp' has the same constrained minimiser as H, and where K is positive definite
  it is a minimum. Elsewhere it is shifted until it is, as by Levenberg and Marquardt.

Then an axis whose |s_k| exceeds 1 is set free, and one whose x_k has passed zero becomes active.
Where neither happens and the step was small, R is a certified local minimiser, up to the square of
the step. What is not certified (starts that are far off, degenerate or mirrored S) is left to the
ADMM of `admm.py`.

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
    """by how much |s_k| may exceed 1, and x_k pass zero"""
    aligned: float
    """sine of the angle to its axis of a normal with two active axes"""


DOUBLE = Tolerances(angle=1e-5, slack=1e-9, aligned=1e-10)
SINGLE = Tolerances(angle=1e-3, slack=1e-5, aligned=1e-6)


def starting_signs(x):
    """Return s (n,3) to begin with, for normals x (n,3) in the cube's frame: no axis active."""
    return np.where(x < 0.0, -1.0, 1.0)


def active_set_rotations(problem, R, s):
    """Return the minimisers near R, in 64 bit; the Taichi kernel does the same step by step.

    Parameters
    ----------
    problem : LocalProblem
    R : (n,3,3) float array
        Rotations to start from.
    s : (n,3) float array
        Subgradients to start from; axes with |s_k| < 1 are active.

    Returns
    -------
    R : (n,3,3) float array
    s : (n,3) float array
    is_done : (n,) bool array
        Which are certified; the others are those given.
    """
    result_R, result_s = R.copy(), s.copy()
    is_done = np.zeros(len(R), bool)
    todo = np.arange(len(R))
    active = np.abs(s) < 1.0
    G = R @ problem.S
    for _ in range(MAX_STEPS):
        if not len(todo):
            break
        W, is_last, is_good = _step(problem, R, G, s, active)
        R, G = W @ R, W @ G
        s, active, is_kept = _next_set(problem, R, G, s, active)
        is_last &= is_kept & is_good
        done = todo[is_last]
        is_done[done] = True
        result_R[done], result_s[done] = R[is_last], s[is_last]
        more = is_good & ~is_last
        todo, problem = todo[more], problem.part(more)
        R, G, s, active = R[more], G[more], s[more], active[more]
    return result_R, result_s, is_done


def _step(problem, R, G, s, active):
    """Return turns W (n,3,3), which may be the last (n,), and which are sound (n,)."""
    is_edge = active.sum(axis=1) == 2
    q, v = np.ones(len(G)), np.zeros((len(G), 3))
    is_last, is_good = np.zeros(len(G), bool), np.zeros(len(G), bool)
    for rows, step in ((is_edge, _turn_about_axis), (~is_edge, _newton_step)):
        part = step(problem.part(rows), R[rows], G[rows], s[rows], active[rows])
        q[rows], v[rows], is_last[rows], is_good[rows] = part
    q[~is_good], v[~is_good] = 1.0, 0.0
    return _turn(q, v), is_last, is_good


def _turn_about_axis(problem, R, G, s, active):
    """Put the normal on its axis t; once it is there, turn about it."""
    y = np.einsum("nij,nj->ni", R, problem.normals)
    t = _from_cube(problem.Q, np.where(active, 0.0, s))
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


def _newton_step(problem, R, G, s, active):
    """Take Newton's step, on the tangent of x_k = 0 where one axis is active."""
    _, normals, Q, lam = problem
    y = np.einsum("nij,nj->ni", R, normals)
    L = G - y[:, :, None] * (lam[:, None] * _from_cube(Q, s))[:, None, :]
    h, number = np.trace(L, axis1=1, axis2=2), active.sum(axis=1)
    p = np.cross(y, _from_cube(Q, active.astype(float)))
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
    excess = (_dot(p, w) + _dot(x, active)) / np.where(is_one, _dot(p, r), 1.0)
    w -= np.where(is_one, excess, 0.0)[:, None] * r
    is_small = _dot(w, w) <= DOUBLE.angle**2
    return np.ones(len(G)), 0.5 * w, is_sound & is_small, is_sound | ~is_small


def curvature_on_tangent(kappa, *entries):
    """Return K = H + kappa pp' for L and p, in the entries of `algebra.py`."""
    x, y, z = entries[9:]
    d, e, f = kappa * x * y, kappa * x * z, kappa * y * z
    squares = (kappa * (x * x), d, e, d, kappa * (y * y), f, e, f, kappa * (z * z))
    return [h + square for h, square in zip(curvature(*entries[:9]), squares, strict=True)]


def _next_set(problem, R, G, s, active):
    """Return s with new multipliers, the active axes, and where both may stay (n,)."""
    _, normals, Q, lam = problem
    y = np.einsum("nij,nj->ni", R, normals)
    x = np.einsum("nij,nj->ni", Q, y)
    has_cost = (lam > 0.0)[:, None]
    force = _axial(G) - lam[:, None] * np.cross(y, _from_cube(Q, np.where(active, 0.0, s)))
    size = np.maximum(1.0 - x * x, 1e-6) * np.where(has_cost, lam[:, None], 1.0)
    multipliers = np.einsum("nij,nj->ni", Q, np.cross(force, y)) / size
    s = np.where(active, multipliers, s)
    crossed = has_cost & ~active & (x * s < -DOUBLE.slack)
    freed = np.abs(s) > 1.0
    is_kept = ~(crossed | (np.abs(s) > 1.0 + DOUBLE.slack)).any(axis=1)
    s, active = np.where(freed, np.sign(s), s), (active & ~freed) | crossed
    size = np.abs(x)
    is_largest = size == size.max(axis=1, keepdims=True)
    freed = is_largest & (active.sum(axis=1) == 3)[:, None]
    return np.where(freed, np.where(x > 0.0, 1.0, -1.0), s), active & ~freed, is_kept


def _turn(q, v):
    """Return the rotations (n,3,3) of the quaternions (q, v), of any length."""
    return from_columns(turn(2.0 / (q * q + _dot(v, v)), q, *v.T))


def _axial(G):
    return from_columns(axial(*columns(G)))


def _from_cube(Q, x):
    return np.einsum("nji,nj->ni", Q, x)


def _dot(a, b):
    return (a * b).sum(axis=1)
