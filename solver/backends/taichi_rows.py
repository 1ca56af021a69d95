# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of a local step whose arrays lie on a device; only these rows are sent. See `HostRows`.

To import this imports the engine.
"""

from functools import cache
from types import SimpleNamespace

import numpy as np

from .engine import kernel_types, state_types, ti
from .taichi_active_set import Kind, covariance


class DeviceRows:
    """As `HostRows`.

    `precision`: {"f64", "f32"}. `width`: {3, 4}, of the states s. `indptr`, `indices`, `gather`,
    `weights`, `area_scale`, `R`, `s`, `energies`: arrays of Taichi, as in `local_step` of
    `taichi_kernels.py`.
    """

    def __init__(
        self, precision, width, indptr, indices, gather, weights, area_scale, R, s, energies
    ):
        self._width = width
        self._kernels = _kernels(precision, width)
        self._real = np.float64 if precision == "f64" else np.float32
        self._edges = indptr, indices, gather, weights, area_scale
        self._R, self._s, self._energies = R, s, energies

    def take(self, U, rows):
        """Return divided covariances, rotations and states of rows."""
        S, R = (np.zeros((len(rows), 3, 3), self._real) for _ in range(2))
        s = np.zeros((len(rows), self._width), self._real)
        self._kernels.take(rows.astype(np.int32), *self._edges, U, self._R, self._s, S, R, s)
        return S.astype(np.float64), R.astype(np.float64), s

    def put(self, rows, R, s, fit, cost):
        """Set rotations and states, and their fit and cost."""
        few = (
            np.ascontiguousarray(a, self._real) for a in (R, s, np.stack([0 * fit, fit, cost], 1))
        )
        self._kernels.put(rows.astype(np.int32), *few, self._R, self._s, self._energies)


@cache
def _kernels(precision, width):
    real = ti.f64 if precision == "f64" else ti.f32
    kind = Kind(real)
    vec3, _, scalars, integers, vectors, matrices = kernel_types(real)
    _, states = state_types(real, width)

    @ti.kernel
    def take(
        rows: integers,
        indptr: integers,
        indices: integers,
        gather: vectors,
        weights: scalars,
        area_scale: scalars,
        U: vectors,
        R: matrices,
        subgradients: states,
        S_few: matrices,
        R_few: matrices,
        s_few: states,
    ):
        for k in range(rows.shape[0]):
            i = rows[k]
            S, _ = covariance(kind, i, U, indptr, indices, gather, weights)
            S_few[k] = S / area_scale[i]
            R_few[k] = R[i]
            s_few[k] = subgradients[i]

    @ti.kernel
    def put(
        rows: integers,
        R_few: matrices,
        s_few: states,
        energies_few: vectors,  # nothing, fit and cost
        R: matrices,
        subgradients: states,
        energies: vectors,
    ):
        for k in range(rows.shape[0]):
            i = rows[k]
            R[i] = R_few[k]
            subgradients[i] = s_few[k]
            _, fit, cost = energies_few[k]
            energies[i] = vec3(energies[i][0], fit, cost)

    return SimpleNamespace(take=take, put=put)
