# SPDX-License-Identifier: GPL-3.0-or-later
"""The local problem by Newton's method with an active set: exact in one to three steps.

Per vertex, with S divided by the area so that nothing depends on scale or tessellation:

    min over R in SO(3):  -tr(R S) + lam h(x),   x = Q R n,

where h is the support function of a body W, such as |x|_1 for the cube. At a minimizer there is a
subgradient s of h, a point of W with s.x = h(x), with which R is stationary for

    -tr(R (S - lam n (Q's)')),

an orthogonal Procrustes problem. s lies on a face of W: a vertex, an edge whose ends cost the same
at x, or the facet whose normal is x. That hardly changes from one iteration to the next, so it is
stored with R, and each step is one of these (Nocedal and Wright, "Numerical Optimization", 2nd
edition, chapter 18, equality-constrained Newton steps with least-squares multipliers):

- on a facet: the normal is that of the facet, and the best turn about it has a closed form;
- else Newton's step of `rotation_fit`, on an edge with direction c on the tangent of x.c = 0. With
  p the gradient of x.c, K = H + kappa pp' has the same constrained minimizer as H, and where K is
  positive definite it is a minimum. Elsewhere it is shifted until it is, as by Levenberg and
  Marquardt.

Then s goes to the vertex or the edge at which it leaves its edge or facet, and to the edge or facet
whose normals x has passed. Where neither happens and the step was small, R is a certified local
minimizer, up to the square of the step. What is not certified (starts that are far off, degenerate
or mirrored S) is left to the ADMM of `admm.py`.

For the cube the faces are found from s itself: s_k is the sign of x_k, but anything in [-1, 1] on
the active axes, those with x_k = 0, of which a vertex has none, an edge one and a facet two.
"""

from dataclasses import dataclass

import numpy as np

from ..algebra import (
    BLOCK,
    adjugate,
    axial,
    by_columns,
    columns,
    cross,
    determinant,
    dot,
    from_columns,
    outer,
    product,
    put,
    shifted,
    size_squared,
    take,
    times,
    trace,
    transposed_times,
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
    """Return the minimizers near R, in 64 bit; the Taichi kernels do the same step by step.

    `problem`: LocalProblem. `R`: (n,3,3), rotations to start from. `states`: (n,w), subgradients to
    start from, and what else the form keeps of a vertex. Returns `R`: (n,3,3); `states`: (n,w);
    `is_done`: (n,) bool, which are certified; the others are those given.
    """
    form, todo = problem.form, np.arange(len(R))
    is_done = np.zeros(len(R), bool)
    new_R, kept = by_columns(R), tuple(map(by_columns, form.begin(states)))
    for _ in range(MAX_STEPS):
        if not len(todo):
            break
        going = []
        for rows, is_on_facet in _blocks(todo, form.active_count(kept)[todo] == 2):
            part, part_R = problem.part(rows), take(new_R, rows)
            part_kept = tuple(take(values, rows) for values in kept)
            part_R, part_kept, is_last, is_good = _step(part, part_R, part_kept, is_on_facet)
            for values, new in zip((new_R, *kept), (part_R, *part_kept), strict=True):
                put(values, rows, new)
            is_done[rows] = is_last
            going.append(rows[is_good & ~is_last])
        todo = np.concatenate(going)
    new_states, others = form.end(kept), np.flatnonzero(~is_done)
    new_R[others], new_states[others] = R[others], states[others]
    return new_R, new_states, is_done


def _blocks(rows, is_on_facet):
    """Yield rows, by number, that take the same kind of step, and whether it is that of a facet."""
    for kind in (False, True):
        same = rows[is_on_facet == kind]
        for begin in range(0, len(same), BLOCK):
            yield same[begin : begin + BLOCK], kind


def _step(problem, R, kept, is_on_facet):
    """Return R and what is kept after a step, and which steps are the last and sound, (n,) each."""
    form, R, normals, Q = problem.form, columns(R), problem.normals.T, columns(problem.Q)
    G = product(*R, *columns(problem.S))
    y = times(*R, *normals)
    s, number, direction = form.constraints(kept)
    if is_on_facet:
        q, v, is_last, is_good = _turn_about_axis(Q, G, y, direction.T)
    else:
        q, v, is_last, is_good = _newton_step(Q, problem.lam, G, y, s.T, number, direction.T)
    q, v = np.where(is_good, q, 1.0), np.where(is_good, v, 0.0)
    W = turn(2.0 / (q * q + dot(*v, *v)), q, *v)
    R, G = product(*W, *R), product(*W, *G)
    y = times(*R, *normals)
    vectors = map(from_columns, (axial(*G), times(*Q, *y), y))
    kept, is_kept = form.next_set(kept, *vectors, problem, DOUBLE.slack)
    return from_columns(R), kept, is_last & is_kept & is_good, is_good


def _turn_about_axis(Q, G, y, direction):
    """Put the normal on its axis t; once it is there, turn about it. Return a quaternion q, v."""
    t = transposed_times(*Q, *direction)
    v = cross(*y, *t)
    q = 1.0 + dot(*y, *t)
    is_good = q > NEAREST_TARGET
    is_last = is_good & (dot(*v, *v) < DOUBLE.aligned**2)
    along = trace(*G) - dot(*t, *times(*G, *t))
    across = dot(*axial(*G), *t)
    best = along + np.sqrt(along * along + across * across)
    q = np.where(is_last, best, q)
    v = np.where(is_last, across * np.asarray(t), v)
    return q, v, is_last, is_good & (~is_last | (best > SMALLEST_TURN * np.abs(across)))


def _newton_step(Q, lam, G, y, s, number, direction):
    """Take Newton's step, on the tangent of x.direction = 0 on an edge. Return as the other."""
    pull = lam * np.asarray(transposed_times(*Q, *s))
    L = np.subtract(G, outer(*y, *pull))
    p = cross(*y, *transposed_times(*Q, *direction))
    kappa = number * (np.abs(trace(*L)) + lam)
    K = curvature_on_tangent(kappa, *L, *p)
    inverse = adjugate(*K)
    is_sound = is_definite(MIN_CURVATURE, *K, *inverse)
    if not is_sound.all():
        K = shifted(np.where(is_sound, 0.0, np.sqrt(size_squared(*K))), *K)
        inverse = adjugate(*K)
    divisor = determinant(*K, *inverse)
    is_zero = divisor == 0.0  # without any force
    inverse = np.divide(inverse, np.where(is_zero, 1.0, divisor))
    w, r = np.asarray(times(*inverse, *axial(*L))), times(*inverse, *p)
    is_one = ~is_zero & (number == 1)
    x = times(*Q, *y)
    excess = (dot(*p, *w) + dot(*x, *direction)) / np.where(is_one, dot(*p, *r), 1.0)
    w -= np.where(is_one, excess, 0.0) * r
    is_small = dot(*w, *w) <= DOUBLE.angle**2
    return 1.0, 0.5 * w, is_sound & is_small, is_sound | ~is_small


def curvature_on_tangent(kappa, *entries):
    """Return K = H + kappa pp' for L and p, in the entries of `algebra.py`."""
    x, y, z = entries[9:]
    d, e, f = kappa * x * y, kappa * x * z, kappa * y * z
    squares = (kappa * (x * x), d, e, d, kappa * (y * y), f, e, f, kappa * (z * z))
    return [h + square for h, square in zip(curvature(*entries[:9]), squares, strict=True)]
