# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cycles of `multigrid.py` as Taichi kernels, in 32 bit: one thread per row.

To import this imports the engine. Vectors have a fourth, unused coordinate:
four of them are read at once, which takes half the time of three. Sums run in a fixed order.
"""

from functools import cache
from types import SimpleNamespace

from .engine import ti

vec = ti.types.vector(4, ti.f32)
values = ti.types.ndarray(dtype=ti.f32, ndim=1)
integers = ti.types.ndarray(dtype=ti.i32, ndim=1)
vectors = ti.types.ndarray(dtype=vec, ndim=1)


@ti.func
def row(
    indptr: ti.template(), indices: ti.template(), data: ti.template(), X: ti.template(), i: ti.i32
):
    """Return row i of the product of a matrix and X."""
    total = vec(0.0)
    for entry in range(indptr[i], indptr[i + 1]):
        total += data[entry] * X[indices[entry]]
    return total


@cache
def make_cycle(level_count):
    """Return the kernel for so many levels above the coarsest.

    Rows of all levels follow each other. The matrices of the levels are scaled to a diagonal of
    ones; `starts` says where the rows of each begin, and where those of the last end.
    """
    square = ti.types.ndarray(dtype=ti.f32, ndim=2)
    per_level = ti.types.vector(level_count + 1, ti.f32)
    bounds = ti.types.vector(level_count + 2, ti.i32)

    @ti.kernel
    def cycle(
        A_indptr: integers,
        A_indices: integers,
        A_data: values,
        P_indptr: integers,
        P_indices: integers,
        P_data: values,
        restrict_indptr: integers,
        restrict_indices: integers,
        restrict_data: values,
        inverse: square,
        B: vectors,
        X: vectors,
        residual: vectors,
        of_b: per_level,
        of_ab: per_level,
        starts: bounds,
    ):
        for k in ti.static(range(level_count)):
            for i in range(starts[k], starts[k + 1]):
                X[i] = of_b[k] * B[i] + of_ab[k] * row(A_indptr, A_indices, A_data, B, i)
            for i in range(starts[k], starts[k + 1]):
                residual[i] = B[i] - row(A_indptr, A_indices, A_data, X, i)
            for i in range(starts[k + 1], starts[k + 2]):
                B[i] = row(restrict_indptr, restrict_indices, restrict_data, residual, i)
        first = starts[level_count]
        for i in range(first, starts[level_count + 1]):
            total = vec(0.0)
            for j in range(inverse.shape[0]):
                total += inverse[i - first, j] * B[first + j]
            X[i] = total
        for back in ti.static(range(level_count)):
            k = ti.static(level_count - 1 - back)
            for i in range(starts[k], starts[k + 1]):
                X[i] += row(P_indptr, P_indices, P_data, X, i)
            for i in range(starts[k], starts[k + 1]):
                residual[i] = B[i] - row(A_indptr, A_indices, A_data, X, i)
            for i in range(starts[k], starts[k + 1]):
                rest = residual[i]
                X[i] += of_b[k] * rest + of_ab[k] * row(A_indptr, A_indices, A_data, residual, i)

    return cycle


@cache
def make_refining_kernels():
    """Return the kernels that come between V-cycles in a row, and after the last."""

    @ti.kernel
    def add(
        indptr: integers,
        indices: integers,
        data: values,
        B: vectors,
        X: vectors,
        total: vectors,
        count: ti.i32,
        weight: ti.f32,
    ):
        """Add a correction to the sum; leave in B what it leaves to the next cycle."""
        for i in range(count):
            B[i] -= weight * row(indptr, indices, data, X, i)
            total[i] += weight * X[i]

    @ti.kernel
    def together(X: vectors, total: vectors, count: ti.i32, weight: ti.f32, factor: ti.f32):
        """Set X to the sum of all corrections, and the sum to zero."""
        for i in range(count):
            X[i] = factor * (total[i] + weight * X[i])
            total[i] = vec(0.0)

    return SimpleNamespace(add=add, together=together)
