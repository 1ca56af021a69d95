# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of a local step that its kernel leaves to another method."""

import numpy as np


class HostRows:
    """Rows of arrays in NumPy; `taichi_rows.py` has the same for those on a device.

    `matrices`: SpokesAndRims. `area_scale`: (n,). `R`, `s`, `energies`: (n,3,3), (n,w) and (n,3),
    rotations, states, and the energies of `local_step` in `taichi_kernels.py`.
    """

    def __init__(self, matrices, area_scale, R, s, energies):
        self._matrices, self._area_scale = matrices, area_scale
        self._R, self._s, self._energies = R, s, energies

    def take(self, U, rows):
        """Return divided covariances (k,3,3), rotations (k,3,3) and states (k,w) of rows.

        `U`: (n,3), positions. `rows`: (k,) int.
        """
        S = self._matrices.covariances(U.astype(np.float64, copy=False), rows)
        S = S / self._area_scale[rows, None, None]
        return S, self._R[rows].astype(np.float64), self._s[rows]

    def put(self, rows, R, s, fit, cost):
        """Set rotations (k,3,3) and states (k,w), and their fit (k,) and cost (k,)."""
        self._R[rows], self._s[rows] = R, s
        self._energies[rows, 1:] = np.stack([fit, cost], axis=1)
