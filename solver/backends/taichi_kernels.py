# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step as Taichi kernels: one thread per vertex, in 64 or 32 bit.

Import this only after `taichi_runtime.import_taichi`. All arrays are kernel arguments, because a
foreign ``ti.init`` destroys fields; sums run in a fixed order and nothing is added atomically, so
that results are the same bit for bit.
"""

# pyright: reportInvalidTypeForm=false, reportGeneralTypeIssues=false, reportOptionalCall=false

from types import SimpleNamespace

import taichi as ti

from ..rotation_fit import MIN_CURVATURE, NEWTON_STEPS


def make_kernels(real):
    """Return the kernels `local_step` and `right_hand_side` for the type ti.f64 or ti.f32."""
    vec3 = ti.types.vector(3, real)
    mat3 = ti.types.matrix(3, 3, real)
    scalars = ti.types.ndarray(dtype=real, ndim=1)
    integers = ti.types.ndarray(dtype=ti.i32, ndim=1)
    vectors = ti.types.ndarray(dtype=vec3, ndim=1)
    matrices = ti.types.ndarray(dtype=mat3, ndim=1)
    # in 32 bit a smaller step than this is rounding, in 64 bit its square is
    angle_tolerance = 1e-6 if real == ti.f64 else 1e-3

    @ti.func
    def orthonormalize(R):
        return R * real(1.5) - R @ (R.transpose() @ R) * real(0.5)

    @ti.func
    def cayley(w):
        x, y, z = w[0] / 2, w[1] / 2, w[2] / 2
        s = 2 / (1 + x * x + y * y + z * z)
        return mat3(
            [
                [1 - s * (y * y + z * z), s * (x * y - z), s * (x * z + y)],
                [s * (x * y + z), 1 - s * (x * x + z * z), s * (y * z - x)],
                [s * (x * z - y), s * (y * z + x), 1 - s * (x * x + y * y)],
            ]
        )

    @ti.func
    def svd_rotation(M):
        # ti.svd returns U and V in SO(3), with the sign of det M in the last singular value
        U, _, V = ti.svd(M, real)
        return V @ U.transpose()

    @ti.func
    def fit_rotation(M, guess):
        """Return argmax tr(R M): see rotation_fit.py, step by step the same."""
        R = guess
        state = 0  # 1: certified, 2: not to be certified
        for _ in range(NEWTON_STEPS):
            if state == 0:
                G = R @ M
                trace = G.trace()
                a, b, c = trace - G[0, 0], trace - G[1, 1], trace - G[2, 2]
                d = -(G[0, 1] + G[1, 0]) / 2
                e = -(G[0, 2] + G[2, 0]) / 2
                f = -(G[1, 2] + G[2, 1]) / 2
                A, B, C = b * c - f * f, a * c - e * e, a * b - d * d
                D, E, K = e * f - d * c, d * f - b * e, d * e - a * f
                determinant = a * A + d * D + e * E
                if (
                    trace > 0
                    and a > 0
                    and C > 0
                    and determinant > real(MIN_CURVATURE) * trace * trace * trace
                ):
                    x, y, z = G[1, 2] - G[2, 1], G[2, 0] - G[0, 2], G[0, 1] - G[1, 0]
                    w = (
                        vec3(A * x + D * y + E * z, D * x + B * y + K * z, E * x + K * y + C * z)
                        / determinant
                    )
                    R = cayley(w) @ R
                    if w.dot(w) <= real(angle_tolerance * angle_tolerance):
                        state = 1
                else:
                    state = 2
        if state != 1:
            R = svd_rotation(M)
        return R

    @ti.func
    def l1(x):
        return ti.abs(x[0]) + ti.abs(x[1]) + ti.abs(x[2])

    @ti.func
    def shrink(x, k):
        return ti.max(x - k, 0) - ti.max(-x - k, 0)

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
        max_iterations: ti.i32,
        absolute: real,
        relative: real,
        rho_min: real,
        rho_max: real,
        balance: real,
        factor: real,
        R_out: matrices,
        zs: vectors,
        us: vectors,
        rhos: scalars,
        energies: vectors,  # per vertex: sum w |d|^2, tr(R S), |Q R n|_1
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

            normal = normals[i]
            Q = Qs[i * q_stride]
            cubeness = lam[i]
            last = orthonormalize(R_out[i])
            R = last
            z, u, rho = zs[i], us[i], rhos[i]
            is_done = False
            count = 0
            while count < max_iterations and not is_done:
                pull = vec3(0.0)
                if cubeness > 0:
                    pull = Q.transpose() @ (z - u) * rho
                R = fit_rotation(S + normal.outer_product(pull), R)
                x = Q @ (R @ normal)
                z_new = shrink(x + u, cubeness / rho)
                u += x - z_new
                primal = (z_new - x).norm()
                dual = rho * (z_new - z).norm()
                z = z_new
                is_done = cubeness == 0 or (
                    primal <= absolute + relative * ti.max(x.norm(), z.norm())
                    and dual <= absolute + relative * rho * u.norm()
                )
                if not is_done:
                    rho_new = rho
                    if primal > balance * dual:
                        rho_new = ti.min(rho * factor, rho_max)
                    elif dual > balance * primal:
                        rho_new = ti.max(rho / factor, rho_min)
                    u *= rho / rho_new
                    rho = rho_new
                count += 1
            zs[i], us[i], rhos[i] = z, u, rho

            # the last rotation stays where the ADMM has not found a better one, so that no
            # iteration raises the energy
            fit, last_fit = (R @ S).trace(), (last @ S).trace()
            cost, last_cost = l1(Q @ (R @ normal)), l1(Q @ (last @ normal))
            if cubeness * cost - fit > cubeness * last_cost - last_fit:
                R, fit, cost = last, last_fit, last_cost
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
