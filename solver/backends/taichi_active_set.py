# SPDX-License-Identifier: GPL-3.0-or-later
"""The local problem of one vertex by an active set, in Taichi; `active_set.py` says how.

To import this imports the engine. These functions are compiled into the kernels
that call them. `kind` is the `Kind` of numbers that they compute with; the masks of the NumPy form
are numbers here, zero or one, to multiply by.
"""

from ..algebra import (
    adjugate,
    axial,
    cross,
    determinant,
    dot,
    outer,
    product,
    shifted,
    size_squared,
    times,
    total,
    trace,
    transposed,
    turn,
)
from ..rotation_fit import MIN_CURVATURE, is_definite
from ..styles.active_set import (
    DOUBLE,
    MAX_STEPS,
    NEAREST_TARGET,
    SINGLE,
    SMALLEST_TURN,
    curvature_on_tangent,
)
from .engine import kernel_types, state_types, ti


class Kind:
    """Numbers of one precision, ti.f64 or ti.f32, and the types of vectors and matrices of them.

    Not a dataclass, of which Quadrants takes the fields apart.
    """

    def __init__(self, real):
        self.real = real
        self.vec3, self.mat3, *_ = kernel_types(real)
        self.vec4, _ = state_types(real, 4)
        self.tolerances = DOUBLE if real == ti.f64 else SINGLE


@ti.func
def covariance(
    kind: ti.template(),
    i,
    U: ti.template(),
    indptr: ti.template(),
    indices: ti.template(),
    gather: ti.template(),
    weights: ti.template(),
):
    """Return S_i of `spokes_and_rims.py`, and sum w |d|^2 over the edges d of vertex i.

    The loop over neighbors could end early, for an index that never comes: else LLVM makes a vector
    loop of it, which gains nothing with six neighbors and takes as long to load as all the rest.
    """
    here = U[i]
    S = kind.mat3(0.0)
    quadratic = kind.real(0.0)
    for entry in range(indptr[i], indptr[i + 1]):
        j = indices[entry]
        if j < 0:
            break
        edge = U[j] - here
        S += kind.mat3(ti.static(outer(*gather[entry], *edge)))
        quadratic += weights[entry] * ti.static([dot(*edge, *edge)])[0]
    return S, quadratic


@ti.func
def rotation_near(kind: ti.template(), S, normal, Q, cubeness, last, last_s):
    """Return R, s, tr(R S), |Q R n|_1, and whether R is certified.

    R and s are the last ones where none better was found, so that no iteration raises the energy.
    """
    R, G, x = in_frame(kind, last, S, normal, Q)
    s, active = last_s, ti.cast(ti.abs(last_s) < 1, kind.real)
    last_fit, last_cost = fit_and_cost(kind, G, x)
    is_done, is_good = False, True
    number = 0
    while number < MAX_STEPS and is_good and not is_done:
        number += 1
        R, G, x, s, active, is_done, is_good = step(kind, R, G, x, s, active, cubeness)
    fit, cost = fit_and_cost(kind, G, x)
    R = kind.mat3(ti.static(product(*transposed(*Q), *R)))
    if not is_done or cubeness * cost - fit > cubeness * last_cost - last_fit:
        R, s, fit, cost = last, last_s, last_fit, last_cost
    return R, s, fit, cost, is_done


@ti.func
def in_frame(kind: ti.template(), R, S, normal, Q):
    """Return R, G = R S and the normal x, rotated, all in the frame of the form.

    With Q R in place of R and S Q' in place of S the objective stays the same, and Q drops out of
    every step.
    """
    turned = kind.mat3(ti.static(product(*Q, *R)))
    covariance = kind.mat3(ti.static(product(*S, *transposed(*Q))))
    G = kind.mat3(ti.static(product(*turned, *covariance)))
    return turned, G, kind.vec3(ti.static(times(*turned, *normal)))


@ti.func
def fit_and_cost(kind: ti.template(), G, x):
    """Return tr(R S) and |Q R n|_1."""
    return ti.static([trace(*G)])[0], ti.static([total(*ti.abs(x))])[0]


@ti.func
def step(kind: ti.template(), R, G, x, s, active, cubeness):
    """Return R, G, x, s and the active axes after a step, whether it is the last, and sound."""
    q, v, is_done, is_good = next_turn(kind, G, x, s, active, cubeness)
    if is_good:
        scale = 2 / (q * q + ti.static([dot(*v, *v)])[0])
        W = kind.mat3(ti.static(turn(scale, q, *v)))
        R = kind.mat3(ti.static(product(*W, *R)))
        G = kind.mat3(ti.static(product(*W, *G)))
        x = kind.vec3(ti.static(times(*W, *x)))
        if cubeness > 0:
            s, active, is_kept = next_set(kind, G, x, s, active, cubeness)
            is_done = is_done and is_kept
    return R, G, x, s, active, is_done and is_good, is_good


@ti.func
def next_turn(kind: ti.template(), G, x, s, active, cubeness):
    """Return a quaternion, whether it may be the last turn, and whether it is sound."""
    q, v = kind.real(1.0), kind.vec3(0.0)
    is_last, is_good = False, True
    number = ti.static([total(*active)])[0]
    if number > 1:
        q, v, is_last, is_good = turn_about_axis(kind, G, x, (1 - active) * s)
    else:
        pull = s * cubeness
        L = G - kind.mat3(ti.static(outer(*x, *pull)))
        p = kind.vec3(ti.static(cross(*x, *active)))
        kappa = number * (ti.abs(ti.static([trace(*L)])[0]) + cubeness)
        w, is_sound = newton_step(kind, L, p, ti.static([dot(*x, *active)])[0], kappa)
        v = w / 2
        is_small = ti.static([dot(*w, *w)])[0] <= kind.real(kind.tolerances.angle**2)
        is_last, is_good = is_sound and is_small, is_sound or not is_small
    return q, v, is_last, is_good


@ti.func
def turn_about_axis(kind: ti.template(), G, y, t):
    """Put the normal y on its axis t; once it is there, turn about it. Return as `next_turn`."""
    v = kind.vec3(ti.static(cross(*y, *t)))
    q = 1 + ti.static([dot(*y, *t)])[0]
    is_good = q > kind.real(NEAREST_TARGET)
    aligned = kind.real(kind.tolerances.aligned**2)
    is_last = is_good and ti.static([dot(*v, *v)])[0] < aligned
    if is_last:
        Gt = kind.vec3(ti.static(times(*G, *t)))
        along = ti.static([trace(*G)])[0] - ti.static([dot(*t, *Gt)])[0]
        across = ti.static([dot(*axial(*G), *t)])[0]
        q = along + ti.sqrt(along * along + across * across)
        v = across * t
        is_good = q > kind.real(SMALLEST_TURN) * ti.abs(across)
    return q, v, is_last, is_good


@ti.func
def newton_step(kind: ti.template(), L, p, excess, kappa):
    """Return a rotation vector, and whether K is positive; p.w is -excess if kappa > 0."""
    K = kind.mat3(ti.static(curvature_on_tangent(kappa, *L, *p)))
    inverse = kind.mat3(ti.static(adjugate(*K)))
    is_sound = ti.static([is_definite(kind.real(MIN_CURVATURE), *K, *inverse)])[0]
    if not is_sound:
        shift = ti.sqrt(ti.static([size_squared(*K)])[0])
        K = kind.mat3(ti.static(shifted(shift, *K)))
        inverse = kind.mat3(ti.static(adjugate(*K)))
    inverse /= ti.static([determinant(*K, *inverse)])[0]
    w = kind.vec3(ti.static(times(*inverse, *axial(*L))))
    if kappa > 0:
        r = kind.vec3(ti.static(times(*inverse, *p)))
        w -= (ti.static([dot(*p, *w)])[0] + excess) / ti.static([dot(*p, *r)])[0] * r
    return w, is_sound


@ti.func
def next_set(kind: ti.template(), G, x, s, active, cubeness):
    """Return s with new multipliers, the active axes, and whether both may stay."""
    slack = kind.tolerances.slack
    fixed = (1 - active) * s
    pull = fixed * cubeness
    force = kind.vec3(ti.static(axial(*G))) - kind.vec3(ti.static(cross(*x, *pull)))
    turning = kind.vec3(ti.static(cross(*force, *x)))
    s = fixed + active * turning / (ti.max(1 - x * x, kind.real(1e-6)) * cubeness)
    size = ti.abs(s)
    freed = size > 1
    free = ti.cast(freed, kind.real)
    crossed = (1 - free) * (1 - active) * ti.cast(x * s < -kind.real(slack), kind.real)
    beyond = ti.cast(size > kind.real(1 + slack), kind.real) + crossed
    is_kept = ti.static([total(*beyond)])[0] == 0
    s = ti.select(freed, 2 * ti.cast(s > 0, kind.real) - 1, s)
    active = (1 - free) * active + crossed
    if ti.static([total(*active)])[0] > 2:
        size = ti.abs(x)
        freed = size == ti.max(*size)
        active = 1 - ti.cast(freed, kind.real)
        s = ti.select(freed, 2 * ti.cast(x > 0, kind.real) - 1, s)
    return s, active, is_kept
