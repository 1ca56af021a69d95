# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step as Taichi kernels: one thread per vertex, in 64 or 32 bit.

Import this only after `taichi_runtime.import_taichi`. All arrays are kernel arguments, because a
foreign ``ti.init`` destroys fields; sums run in a fixed order and nothing is added atomically, so
that results are the same bit for bit.
"""

# pyright: reportInvalidTypeForm=false, reportGeneralTypeIssues=false, reportOptionalCall=false
# pyright: reportIndexIssue=false

from types import SimpleNamespace

import taichi as ti

from ..active_set import DOUBLE, MAX_STEPS, NEAREST_TARGET, SINGLE, SMALLEST_TURN
from ..rotation_fit import MIN_CURVATURE


def make_kernels(real):
    """Return the kernels `local_step` and `right_hand_side` for the type ti.f64 or ti.f32."""
    vec3 = ti.types.vector(3, real)
    mat3 = ti.types.matrix(3, 3, real)
    scalars = ti.types.ndarray(dtype=real, ndim=1)
    integers = ti.types.ndarray(dtype=ti.i32, ndim=1)
    vectors = ti.types.ndarray(dtype=vec3, ndim=1)
    matrices = ti.types.ndarray(dtype=mat3, ndim=1)
    tolerances = DOUBLE if real == ti.f64 else SINGLE
    angle, slack, aligned = tolerances.angle, tolerances.slack, tolerances.aligned

    @ti.func
    def orthonormalize(R):
        return R * real(1.5) - R @ (R.transpose() @ R) * real(0.5)

    @ti.func
    def turn(q, v):
        """Return the rotation of the quaternion (q, v), of any length."""
        s = 2 / (q * q + v.dot(v))
        x, y, z = v[0], v[1], v[2]
        return mat3(
            [
                [1 - s * (y * y + z * z), s * (x * y - z * q), s * (x * z + y * q)],
                [s * (x * y + z * q), 1 - s * (x * x + z * z), s * (y * z - x * q)],
                [s * (x * z - y * q), s * (y * z + x * q), 1 - s * (x * x + y * y)],
            ]
        )

    @ti.func
    def axial(G):
        return vec3(G[1, 2] - G[2, 1], G[2, 0] - G[0, 2], G[0, 1] - G[1, 0])

    @ti.func
    def l1(x):
        return ti.abs(x[0]) + ti.abs(x[1]) + ti.abs(x[2])

    @ti.func
    def turn_about_axis(G, y, t):
        """Return a quaternion, whether it may be the last turn, and whether it is sound."""
        v = y.cross(t)
        q = 1 + y.dot(t)
        is_good = q > real(NEAREST_TARGET)
        is_last = is_good and v.dot(v) < real(aligned * aligned)
        if is_last:
            along = G.trace() - t.dot(G @ t)
            across = axial(G).dot(t)
            q = along + ti.sqrt(along * along + across * across)
            v = across * t
            is_good = q > real(SMALLEST_TURN) * ti.abs(across)
        return q, v, is_last, is_good

    @ti.func
    def newton_step(L, p, excess, kappa):
        """Return a rotation vector, and whether K is positive; p.w is -excess if kappa > 0."""
        g = axial(L)
        h = L.trace()
        a = h - L[0, 0] + kappa * p[0] * p[0]
        b = h - L[1, 1] + kappa * p[1] * p[1]
        c = h - L[2, 2] + kappa * p[2] * p[2]
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
                inverse = mat3([[A, D, E], [D, B, F], [E, F, C]]) / determinant
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
        w = inverse @ g
        if kappa > 0:
            r = inverse @ p
            w -= (p.dot(w) + excess) / p.dot(r) * r
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
                edge = U[indices[entry]] - here
                S += gather[entry].outer_product(edge)
                quadratic += weights[entry] * edge.dot(edge)
            S /= area_scale[i]

            # from here as in active_set.py
            normal = normals[i]
            Q = Qs[i * q_stride]
            cubeness = lam[i]
            last = orthonormalize(R_out[i])
            R, G, y = last, last @ S, last @ normal
            x = Q @ y
            last_fit, last_cost = G.trace(), l1(x)
            s = subgradients[i]
            active = ti.cast(ti.abs(s) < 1, real)
            is_done, is_good = False, True
            step = 0
            while step < MAX_STEPS and is_good and not is_done:
                step += 1
                number = active.sum()
                q, v = real(1.0), vec3(0.0)
                if number > 1:
                    t = Q.transpose() @ ((1 - active) * s)
                    q, v, is_done, is_good = turn_about_axis(G, y, t)
                else:
                    L = G - y.outer_product(Q.transpose() @ s * cubeness)
                    p = y.cross(Q.transpose() @ active)
                    kappa = number * (ti.abs(L.trace()) + cubeness)
                    w, is_sound = newton_step(L, p, x.dot(active), kappa)
                    v = w / 2
                    is_small = w.dot(w) <= real(angle * angle)
                    is_done, is_good = is_sound and is_small, is_sound or not is_small
                if is_good:
                    W = turn(q, v)
                    R = W @ R
                    G = W @ G
                    y = R @ normal
                    x = Q @ y
                    if cubeness > 0:
                        fixed = (1 - active) * s
                        force = axial(G) - y.cross(Q.transpose() @ fixed) * cubeness
                        size = ti.max(1 - x * x, real(1e-6)) * cubeness
                        s = fixed + active * (Q @ force.cross(y)) / size
                        for k in ti.static(range(3)):
                            if ti.abs(s[k]) > 1:
                                is_done = is_done and ti.abs(s[k]) <= real(1 + slack)
                                s[k] = 1 if s[k] > 0 else -1
                                active[k] = 0
                            elif active[k] == 0 and x[k] * s[k] < -real(slack):
                                is_done = False
                                active[k] = 1
                        if active.sum() > 2:
                            largest = ti.abs(x).max()
                            for k in ti.static(range(3)):
                                if ti.abs(x[k]) == largest:
                                    active[k] = 0
                                    s[k] = 1 if x[k] > 0 else -1
            is_done = is_done and is_good

            # the last rotation stays where none better was found, so that no iteration raises the
            # energy
            fit, cost = G.trace(), l1(x)
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
                total += R[indices[entry]] @ scatter[entry]
            rhs[i] = total / 3

    return SimpleNamespace(local_step=local_step, right_hand_side=right_hand_side)
