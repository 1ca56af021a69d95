# SPDX-License-Identifier: GPL-3.0-or-later
"""The types of what the kernels are given. To import this imports the engine."""

from .engine import ti


def kernel_types(real):
    """Return the types of vectors and matrices, and of arrays of one dimension.

    `real`: ti.f64 or ti.f32. Returns vec3, mat3, scalars, integers, vectors, matrices.
    """
    vec3, mat3 = ti.types.vector(3, real), ti.types.matrix(3, 3, real)
    return vec3, mat3, *(ti.types.ndarray(dtype=t, ndim=1) for t in (real, ti.i32, vec3, mat3))


def state_types(real, width):
    """Return the types of a vertex's state, a vector of that width, and of an array of them."""
    state = ti.types.vector(width, real)
    return state, ti.types.ndarray(dtype=state, ndim=1)
