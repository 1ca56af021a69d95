# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep a component from turning as a whole, by linear constraints of the global step.

The best-fit rotation of a component is the identity where its covariance with the rest positions is
symmetric, that is where

    t(U) = sum_i w_i x_i x u_i = 0,    x_i = v_i - c

(the torque of the positions about the center). Among the positions that obey it, those of least
energy are U + mu x P with P = L^-1 (w x) and, with M = sum_i w_i P_i x_i', the mu that solves

    (tr(M) 1 - M) mu = -t(U)

The iteration is therefore a descent as without the constraint, among fewer positions. Rotating the
component back after each step would cost energy, possibly more than the step has gained.
"""

from functools import cached_property

import numpy as np

from ..algebra import AXIAL

SMALLEST = 1e-9
"""relative stiffness that still counts: what lies on a line may turn about it"""


class NoTurning:
    """The constraints of all components that are to keep their orientation.

    `is_free`: (component_count,) bool, components without a pinned vertex; the others are left
    alone. `solve`: maps B (n,3) to the solution X (n,3) of L X = B, or to what is near it.

    `pull`, `P`: (n,3), w x and P as above, zero in components with a pinned vertex.
    """

    def __init__(self, rest, is_free, solve):
        self._topology = topology = rest.topology
        share = topology.shares(rest.standing)
        center = topology.sum_parts(share[:, None] * rest.V)
        x = (rest.V - center[topology.component]) * is_free[topology.component][:, None]
        self.pull = share[:, None] * x
        self._is_idle = not is_free.any()
        P = np.zeros_like(x) if self._is_idle else solve(self.pull)
        share = topology.shares(rest.weighing)  # so that the centroid stays where it is
        P -= topology.sum_parts(share[:, None] * P)[topology.component]
        self.P = P * is_free[topology.component][:, None]
        M = topology.sum_parts((self.P[:, :, None] * self.pull[:, None, :]).reshape(-1, 9))
        M = M.reshape(-1, 3, 3)
        M = 0.5 * (M + M.swapaxes(1, 2))
        stiffness = np.trace(M, axis1=1, axis2=2)[:, None, None] * np.eye(3) - M
        self._inverse = np.linalg.pinv(stiffness, rcond=SMALLEST, hermitian=True)

    @cached_property
    def _sparse(self):
        """P and the transpose of pull by component; a GPU has kernels instead."""
        by_component = self._topology.by_component
        return by_component(self.P), by_component(self.pull).T

    def impose(self, U):
        """Move positions U (n,3), in place, to the nearest in which nothing has turned."""
        if not self._is_idle:
            ways, pulls = self._sparse
            mu = self.twist((pulls @ U).reshape(-1, 9) @ AXIAL)
            U += ways @ (mu @ AXIAL.T).reshape(-1, 3)

    def twist(self, torques):
        """Return mu (component_count,3) for the torques (component_count,3)."""
        return -np.einsum("kij,kj->ki", self._inverse, torques)
