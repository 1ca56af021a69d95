# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cycle of `multigrid.py` as Taichi kernels, in 32 bit: one thread per row.

Import this only after `taichi_runtime.import_taichi`. Vectors have a fourth, unused coordinate:
four of them are read at once, which takes half the time of three. Sums run in a fixed order.
"""

# pyright: reportInvalidTypeForm=false, reportGeneralTypeIssues=false, reportOptionalCall=false
# pyright: reportIndexIssue=false

from types import SimpleNamespace

import taichi as ti


def make_cycle_kernels():
    """Return the kernels of a level; its matrix A is scaled to a diagonal of ones."""
    vec = ti.types.vector(4, ti.f32)
    values = ti.types.ndarray(dtype=ti.f32, ndim=1)
    integers = ti.types.ndarray(dtype=ti.i32, ndim=1)
    vectors = ti.types.ndarray(dtype=vec, ndim=1)
    square = ti.types.ndarray(dtype=ti.f32, ndim=2)

    @ti.func
    def row(
        indptr: ti.template(),
        indices: ti.template(),
        data: ti.template(),
        X: ti.template(),
        i: ti.i32,
    ):
        total = vec(0.0)
        for entry in range(indptr[i], indptr[i + 1]):
            total += data[entry] * X[indices[entry]]
        return total

    @ti.kernel
    def smooth(
        indptr: integers,
        indices: integers,
        data: values,
        B: vectors,
        X: vectors,
        of_b: ti.f32,
        of_ab: ti.f32,
    ):
        """Set X = of_b B + of_ab A B."""
        for i in range(X.shape[0]):
            X[i] = of_b * B[i] + of_ab * row(indptr, indices, data, B, i)

    @ti.kernel
    def smooth_more(
        indptr: integers,
        indices: integers,
        data: values,
        B: vectors,
        X: vectors,
        of_b: ti.f32,
        of_ab: ti.f32,
    ):
        """Add of_b B + of_ab A B to X."""
        for i in range(X.shape[0]):
            X[i] += of_b * B[i] + of_ab * row(indptr, indices, data, B, i)

    @ti.kernel
    def subtract(
        indptr: integers, indices: integers, data: values, X: vectors, B: vectors, residual: vectors
    ):
        """Set residual = B - A X."""
        for i in range(residual.shape[0]):
            residual[i] = B[i] - row(indptr, indices, data, X, i)

    @ti.kernel
    def multiply(indptr: integers, indices: integers, data: values, X: vectors, Y: vectors):
        """Set Y = A X."""
        for i in range(Y.shape[0]):
            Y[i] = row(indptr, indices, data, X, i)

    @ti.kernel
    def add(indptr: integers, indices: integers, data: values, X: vectors, Y: vectors):
        """Add A X to Y."""
        for i in range(Y.shape[0]):
            Y[i] += row(indptr, indices, data, X, i)

    @ti.kernel
    def multiply_dense(A: square, X: vectors, Y: vectors):
        for i in range(Y.shape[0]):
            total = vec(0.0)
            for j in range(X.shape[0]):
                total += A[i, j] * X[j]
            Y[i] = total

    return SimpleNamespace(
        smooth=smooth,
        smooth_more=smooth_more,
        subtract=subtract,
        multiply=multiply,
        add=add,
        multiply_dense=multiply_dense,
    )
