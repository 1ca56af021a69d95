# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step for the cube on a processor, a few vertices at once by vector instructions.

To import this imports the engine. Taichi writes no vector instructions, but
LLVM does for a loop of fixed length whose turns only touch arrays of their own: here the loops over
the lanes, a vertex in each, between the loops that read from the mesh and write to it. There LLVM
computes both ways of each branch, so that it pays for few and short ones; all lanes step until the
last one has its rotation.
"""

from ..algebra import nearer_to_orthogonal, product, transposed
from ..styles.active_set import MAX_STEPS
from .engine import kernel_types, ti
from .taichi_active_set import covariance, fit_and_cost, in_frame, step

LANES = 4
"""vertices; as many numbers of 64 bit are in a vector of AVX2"""


def make_local_step(kind):
    """Return the kernel `local_step` as `make_kernels` does, without `face_tables`."""
    real = kind.real
    vec3, mat3, scalars, integers, vectors, matrices = kernel_types(real)
    places9 = ti.types.vector(9, ti.i32)  # whatever the default type of integers is
    lanes1, lanes3, lanes9 = (ti.types.vector(size * LANES, real) for size in (1, 3, 9))

    # An array holds a first entry of all lanes, then a second one, and so on.

    @ti.func
    def places(lane):
        return places9([LANES * entry + lane for entry in ti.static(range(9))])

    @ti.func
    def vector(of: ti.template(), at):
        return vec3([of[at[entry]] for entry in ti.static(range(3))])

    @ti.func
    def matrix(of: ti.template(), at):
        return mat3([of[at[entry]] for entry in ti.static(range(9))])

    @ti.func
    def set_vector(of: ti.template(), at, values):
        for entry in ti.static(range(3)):
            of[at[entry]] = values[entry]

    @ti.func
    def set_matrix(of: ti.template(), at, values):
        for entry in ti.static(range(9)):
            of[at[entry]] = values[entry // 3, entry % 3]

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
        Q: matrices,
        q_stride: ti.i32,
        R: matrices,
        subgradients: vectors,
        energies: vectors,
        certified: integers,
    ):
        count = lam.shape[0]
        for block in range((count + LANES - 1) // LANES):
            l_R, l_G, l_S, l_Q = lanes9(0.0), lanes9(0.0), lanes9(0.0), lanes9(0.0)
            l_x, l_s, l_active = lanes3(0.0), lanes3(0.0), lanes3(0.0)
            quadratic, fit, cost, cubeness = lanes1(0.0), lanes1(0.0), lanes1(0.0), lanes1(0.0)
            is_going, is_done = lanes1(1.0), lanes1(0.0)
            for k in range(LANES):
                at = places(k)
                i = ti.min(block * LANES + k, count - 1)
                S, square = covariance(kind, i, U, indptr, indices, gather, weights)
                S /= area_scale[i]
                set_matrix(l_S, at, S)
                set_matrix(l_R, at, R[i])
                set_matrix(l_Q, at, Q[i * q_stride])
                set_vector(l_x, at, normals[i])
                set_vector(l_s, at, subgradients[i])
                quadratic[k], cubeness[k] = square, lam[i]
            for k in range(LANES):
                at = places(k)
                present = matrix(l_R, at)
                near = mat3(ti.static(nearer_to_orthogonal(*present)))
                turned, G, x = in_frame(
                    kind, near, matrix(l_S, at), vector(l_x, at), matrix(l_Q, at)
                )
                fit[k], cost[k] = fit_and_cost(kind, G, x)
                set_vector(l_active, at, ti.cast(ti.abs(vector(l_s, at)) < 1, real))
                set_matrix(l_R, at, turned)
                set_matrix(l_G, at, G)
                set_vector(l_x, at, x)
            number, is_any_going = 0, True
            while number < MAX_STEPS and is_any_going:
                number += 1
                for k in range(LANES):
                    at = places(k)
                    turned, G, x = matrix(l_R, at), matrix(l_G, at), vector(l_x, at)
                    s, active = vector(l_s, at), vector(l_active, at)
                    going, done = is_going[k], is_done[k]
                    if going > 0:
                        turned, G, x, s, active, is_last, is_good = step(
                            kind, turned, G, x, s, active, cubeness[k]
                        )
                        done = ti.cast(is_last, real)
                        going = ti.cast(is_good and not is_last, real)
                    set_matrix(l_R, at, turned)
                    set_matrix(l_G, at, G)
                    set_vector(l_x, at, x)
                    set_vector(l_s, at, s)
                    set_vector(l_active, at, active)
                    is_going[k], is_done[k] = going, done
                left = real(0.0)
                for k in range(LANES):
                    left += is_going[k]
                is_any_going = left > 0
            for k in range(LANES):
                at = places(k)
                i = ti.min(block * LANES + k, count - 1)
                new_fit, new_cost = fit_and_cost(kind, matrix(l_G, at), vector(l_x, at))
                is_better = lam[i] * new_cost - new_fit <= lam[i] * cost[k] - fit[k]
                if is_done[k] > 0 and is_better:
                    turned, frame = matrix(l_R, at), Q[i * q_stride]
                    R[i] = mat3(ti.static(product(*transposed(*frame), *turned)))
                    subgradients[i] = vector(l_s, at)
                    fit[k], cost[k] = new_fit, new_cost
                energies[i] = vec3(quadratic[k], fit[k] * area_scale[i], cost[k])
                certified[i] = ti.cast(is_done[k], ti.i32)

    return local_step
