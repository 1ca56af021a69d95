# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step as Taichi kernels: one thread per vertex, in 64 or 32 bit.

A processor has that of `taichi_lanes.py` for the cube, of a few vertices at once.

To import this imports the engine. All arrays are kernel arguments, because a
foreign ``ti.init`` destroys fields; sums run in a fixed order and nothing is added atomically, so
that results are the same bit for bit.

Python runs through each kernel once per process, even when it is compiled already, and spends about
as long on a product of two matrices in Taichi's own words as on a hundred products of scalars. So
small algebra is that of `algebra.py`, on entries; what is left are vectors and control flow. The
loop over neighbors could end early, as that of `covariance`.
"""

from types import SimpleNamespace
from typing import Any

from ..algebra import nearer_to_orthogonal, times
from .engine import kernel_types, state_types, ti
from .face_tables import FaceTables
from .taichi_active_set import Kind, covariance, rotation_near
from .taichi_faces import rotation_on_faces
from .taichi_lanes import make_local_step as in_lanes


def make_kernels(real, width, has_lanes=False):
    """Return the kernels `local_step` and `right_hand_side`.

    `real`: ti.f64 or ti.f32. `width`: of the states of vertices: 3 for the cube, 4 for polytopes.
    `has_lanes`: whether the processor computes a few vertices at once; for the cube, and not on a
    GPU. The kernel is then not given `face_tables`.
    """
    vec3, mat3, scalars, integers, vectors, matrices = kernel_types(real)
    _, states = state_types(real, width)
    kind = Kind(real)
    is_cube = width == 3

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
        subgradients: states,
        energies: vectors,  # per vertex: sum w |d|^2, and the `costs` of a `LocalProblem`
        certified: integers,  # where 0, the rotation is the last one
        frames: matrices,  # as `face_tables` returns them
        numbers: integers,
        targets: integers,
        ways: vectors,
        between: integers,
        edge_start: ti.i32,
        facet_start: ti.i32,
    ):
        tables = ti.static(
            FaceTables(frames, numbers, targets, ways, between, edge_start, facet_start)
        )
        for i in range(lam.shape[0]):
            S, quadratic = covariance(kind, i, U, indptr, indices, gather, weights)
            S /= area_scale[i]
            present = R[i]
            last = mat3(ti.static(nearer_to_orthogonal(*present)))
            if ti.static(is_cube):
                rotation, s, fit, cost, is_certified = rotation_near(
                    kind, S, normals[i], Q[i * q_stride], lam[i], last, subgradients[i]
                )
                R[i] = rotation
                subgradients[i] = s
                energies[i] = vec3(quadratic, fit * area_scale[i], cost)
                certified[i] = ti.cast(is_certified, ti.i32)
            else:
                rotation, s, fit, cost, is_certified = rotation_on_faces(
                    kind, S, normals[i], Q[i * q_stride], lam[i], last, subgradients[i], tables
                )
                R[i] = rotation
                subgradients[i] = s
                energies[i] = vec3(quadratic, fit * area_scale[i], cost)
                certified[i] = ti.cast(is_certified, ti.i32)

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

    of_rotations: Any = in_lanes(kind) if has_lanes else local_step
    return SimpleNamespace(local_step=of_rotations, right_hand_side=right_hand_side)
