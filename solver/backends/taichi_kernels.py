# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step as Taichi kernels: one thread per vertex, in 64 or 32 bit.

Import this only after `taichi_runtime.import_taichi`. All arrays are kernel arguments, because a
foreign ``ti.init`` destroys fields; sums run in a fixed order and nothing is added atomically, so
that results are the same bit for bit.

Python runs through each kernel once per process, even when it is compiled already, and spends about
as long on a product of two matrices in Taichi's own words as on a hundred products of scalars. So
small algebra is `compile_time_algebra`, on entries; what is left are vectors and control flow. The
loops over neighbours could end early, for an index that never comes: else LLVM makes vector loops
of them, which gain nothing with six neighbours and take as long to load as all the rest.
"""

# pyright: reportInvalidTypeForm=false, reportGeneralTypeIssues=false, reportOptionalCall=false
# pyright: reportIndexIssue=false

from types import SimpleNamespace

import taichi as ti

from ..rotation_fit import MIN_CURVATURE
from ..styles.active_set import DOUBLE, MAX_STEPS, NEAREST_TARGET, SINGLE, SMALLEST_TURN
from .compile_time_algebra import (
    axial,
    cross,
    dot,
    gram,
    outer,
    product,
    times,
    total,
    trace,
    transposed_times,
    turn,
)
from .kernel_types import kernel_types


def make_kernels(real):
    """Return the kernels `local_step` and `right_hand_side` for the type ti.f64 or ti.f32."""
    vec3, mat3, scalars, integers, vectors, matrices = kernel_types(real)
    tolerances = DOUBLE if real == ti.f64 else SINGLE
    angle, slack, aligned = tolerances.angle, tolerances.slack, tolerances.aligned

    @ti.func
    def turn_about_axis(G, y, t):
        """Return a quaternion, whether it may be the last turn, and whether it is sound."""
        v = vec3(ti.static(cross(*y, *t)))
        q = 1 + ti.static(dot(*y, *t))[0]
        is_good = q > real(NEAREST_TARGET)
        is_last = is_good and ti.static(dot(*v, *v))[0] < real(aligned * aligned)
        if is_last:
            Gt = vec3(ti.static(times(*G, *t)))
            along = ti.static(trace(*G))[0] - ti.static(dot(*t, *Gt))[0]
            across = ti.static(dot(*axial(*G), *t))[0]
            q = along + ti.sqrt(along * along + across * across)
            v = across * t
            is_good = q > real(SMALLEST_TURN) * ti.abs(across)
        return q, v, is_last, is_good

    @ti.func
    def newton_step(L, p, excess, kappa):
        """Return a rotation vector, and whether K is positive; p.w is -excess if kappa > 0."""
        g = vec3(ti.static(axial(*L)))
        diagonal = ti.static(trace(*L))[0] - vec3(L[0, 0], L[1, 1], L[2, 2]) + kappa * p * p
        a, b, c = diagonal
        d = -(L[0, 1] + L[1, 0]) / 2 + kappa * p[0] * p[1]
        e = -(L[0, 2] + L[2, 0]) / 2 + kappa * p[0] * p[2]
        f = -(L[1, 2] + L[2, 1]) / 2 + kappa * p[1] * p[2]
        is_sound = True
        inverse = mat3(0.0)
        for attempt in range(2):
            if attempt == 0 or not is_sound:
                A, B, C = b * c - f * f, a * c - e * e, a * b - d * d
                D, E, F = e * f - d * c, d * f - b * e, d * e - a * f
                determinant = a * A + d * D + e * E
                inverse = mat3([A, D, E, D, B, F, E, F, C]) / determinant
                half_trace = (a + b + c) / 2
                if attempt == 0 and not (
                    half_trace > 0
                    and a > 0
                    and C > 0
                    and determinant > real(MIN_CURVATURE) * half_trace * half_trace * half_trace
                ):
                    is_sound = False
                    shift = ti.sqrt(a * a + b * b + c * c + 2 * (d * d + e * e + f * f))
                    a += shift
                    b += shift
                    c += shift
        w = vec3(ti.static(times(*inverse, *g)))
        if kappa > 0:
            r = vec3(ti.static(times(*inverse, *p)))
            w -= (ti.static(dot(*p, *w))[0] + excess) / ti.static(dot(*p, *r))[0] * r
        return w, is_sound

    @ti.kernel
    def local_step(
        U: vectors,
        indptr: integers,
        indices: integers,
        gather: vectors,
        weights: scalars,
        normals: vectors,
        area_scale: scalars,
        lam: scalars,
        Qs: matrices,
        q_stride: ti.i32,
        R_out: matrices,
        subgradients: vectors,
        energies: vectors,  # per vertex: sum w |d|^2, tr(R S), |Q R n|_1
        certified: integers,  # where 0, the rotation is the last one
    ):
        for i in range(lam.shape[0]):
            here = U[i]
            S = mat3(0.0)
            quadratic = real(0.0)
            for entry in range(indptr[i], indptr[i + 1]):
                j = indices[entry]
                if j < 0:
                    break
                edge = U[j] - here
                S += mat3(ti.static(outer(*gather[entry], *edge)))
                quadratic += weights[entry] * ti.static(dot(*edge, *edge))[0]
            S /= area_scale[i]

            # from here as in active_set.py
            normal = normals[i]
            Q = Qs[i * q_stride]
            cubeness = lam[i]
            R = R_out[i]
            last = R * real(1.5) - mat3(ti.static(product(*R, *gram(*R)))) * real(0.5)
            R = last
            G = mat3(ti.static(product(*R, *S)))
            y = vec3(ti.static(times(*R, *normal)))
            x = vec3(ti.static(times(*Q, *y)))
            last_fit, last_cost = ti.static(trace(*G))[0], ti.static(total(*ti.abs(x)))[0]
            s = subgradients[i]
            active = ti.cast(ti.abs(s) < 1, real)
            is_done, is_good = False, True
            step = 0
            while step < MAX_STEPS and is_good and not is_done:
                step += 1
                number = ti.static(total(*active))[0]
                q, v = real(1.0), vec3(0.0)
                if number > 1:
                    t = vec3(ti.static(transposed_times(*Q, *((1 - active) * s))))
                    q, v, is_done, is_good = turn_about_axis(G, y, t)
                else:
                    pull = vec3(ti.static(transposed_times(*Q, *(s * cubeness))))
                    L = G - mat3(ti.static(outer(*y, *pull)))
                    p = vec3(ti.static(cross(*y, *transposed_times(*Q, *active))))
                    kappa = number * (ti.abs(ti.static(trace(*L))[0]) + cubeness)
                    w, is_sound = newton_step(L, p, ti.static(dot(*x, *active))[0], kappa)
                    v = w / 2
                    is_small = ti.static(dot(*w, *w))[0] <= real(angle * angle)
                    is_done, is_good = is_sound and is_small, is_sound or not is_small
                if is_good:
                    scale = 2 / (q * q + ti.static(dot(*v, *v))[0])
                    W = mat3(ti.static(turn(scale, q, *v)))
                    R = mat3(ti.static(product(*W, *R)))
                    G = mat3(ti.static(product(*W, *G)))
                    y = vec3(ti.static(times(*R, *normal)))
                    x = vec3(ti.static(times(*Q, *y)))
                    if cubeness > 0:
                        fixed = (1 - active) * s
                        pull = vec3(ti.static(transposed_times(*Q, *fixed))) * cubeness
                        force = vec3(ti.static(axial(*G))) - vec3(ti.static(cross(*y, *pull)))
                        turning = vec3(ti.static(times(*Q, *cross(*force, *y))))
                        s = fixed + active * turning / (ti.max(1 - x * x, real(1e-6)) * cubeness)
                        size = ti.abs(s)
                        freed = size > 1
                        free = ti.cast(freed, real)
                        crossed = (1 - free) * (1 - active) * ti.cast(x * s < -real(slack), real)
                        beyond = ti.cast(size > real(1 + slack), real) + crossed
                        is_done = is_done and ti.static(total(*beyond))[0] == 0
                        s = ti.select(freed, 2 * ti.cast(s > 0, real) - 1, s)
                        active = (1 - free) * active + crossed
                        if ti.static(total(*active))[0] > 2:
                            size = ti.abs(x)
                            freed = size == ti.max(*size)
                            active = 1 - ti.cast(freed, real)
                            s = ti.select(freed, 2 * ti.cast(x > 0, real) - 1, s)
            is_done = is_done and is_good

            # the last rotation stays where none better was found, so that no iteration raises the
            # energy
            fit, cost = ti.static(trace(*G))[0], ti.static(total(*ti.abs(x)))[0]
            if not is_done or cubeness * cost - fit > cubeness * last_cost - last_fit:
                R, fit, cost = last, last_fit, last_cost
            else:
                subgradients[i] = s
            certified[i] = ti.cast(is_done, ti.i32)
            R_out[i] = R
            energies[i] = vec3(quadratic, fit * area_scale[i], cost)

    @ti.kernel
    def right_hand_side(
        indptr: integers, indices: integers, scatter: vectors, R: matrices, rhs: vectors
    ):
        for i in range(rhs.shape[0]):
            total = vec3(0.0)
            for entry in range(indptr[i], indptr[i + 1]):
                j = indices[entry]
                if j < 0:
                    break
                total += vec3(ti.static(times(*R[j], *scatter[entry])))
            rhs[i] = total / 3

    return SimpleNamespace(local_step=local_step, right_hand_side=right_hand_side)
