# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step in NumPy: runs everywhere, and is what the tests compare Taichi with."""

from typing import Any

import numpy as np

from ..algebra import by_columns, from_columns
from ..global_step.motion import Motion
from ..rotation_fit import orthonormalize
from ..styles.active_set import active_set_rotations
from ..styles.admm import admm_rotations
from ..styles.cube import CUBE
from ..styles.local_problem import LocalProblem

SMALLEST_AREA = 1e-30
"""in the unit box; less is no area, and would overflow in 32 bit"""


class NumpyLocalStep:
    """Rotations from positions, and the right-hand side of the global step from rotations.

    `rest`: RestMesh. `lam`: (n,), cubeness. `Q`: (n,3,3) or (1,3,3), orientation of the form: maps
    a vector into its frame. `options`: AdmmOptions. `form`: Cube or Polytopes, what the normals are
    drawn to. `normals`: (n,3), optional, unit normals at rest, or zero; by default those of the
    surface as it is.

    `R`: (n,3,3), rotations, the identity at first. `resolution`: distance in the unit box below
    which everything is rounding.
    """

    device = "numpy"
    compile_seconds = 0.0
    resolution = 1e-9

    def __init__(self, rest, lam, Q, options, form: Any = CUBE, normals=None):
        self._rest = rest
        normals = rest.normals if normals is None else normals
        self._options = options
        matrices = rest.matrices
        self._laplacian = matrices.matrix(matrices.laplacian)
        self._gather = [matrices.matrix(matrices.gather[:, c]) for c in range(3)]
        self._scatter = [matrices.matrix(matrices.scatter[:, c]) for c in range(3)]
        self._area_scale = area_scale(rest.areas)
        _, self._first = np.unique(rest.topology.component, return_index=True)
        self._rest_quadratic = self._quadratic(self._near_origin(rest.V))
        n = len(rest.V)
        self.R = np.tile(np.eye(3), (n, 1, 1))
        lam = local_cubeness(rest.areas, normals, lam)
        nothing = np.zeros((n, 3, 3))
        self._rest_problem = LocalProblem(nothing, by_columns(normals), by_columns(Q), lam, form)
        self._normal_weight = lam * rest.areas
        self._states = self._rest_problem.starting(self.R)

    def motion(self, setup, U, constraints=()):
        """Return the Motion that follows these rotations, from positions U (n,3)."""
        return Motion(setup, self, U, constraints)

    def start_from(self, R):
        """Begin with rotations (n,3,3)."""
        self.R[:] = R
        self._states = self._rest_problem.starting(R)

    def update(self, U):
        """Fit all rotations to the positions U (n,3).

        Returns `arap`, `cubic`: (component_count,), energies of the positions with these rotations.
        """
        U = self._near_origin(U)
        S = np.empty((9, len(U)))
        for row, H in zip(S.reshape(3, 3, -1), self._gather, strict=True):
            np.divide((H @ U).T, self._area_scale, out=row)
        problem = self._rest_problem.with_covariances(from_columns(S))
        last = orthonormalize(self.R)
        R, states, is_done = active_set_rotations(problem, last, self._states)
        rows = np.flatnonzero(~is_done)
        if len(rows):
            R[rows], states[rows] = admm_rotations(
                problem.part(rows), last[rows], states[rows], self._options
            )
        is_worse = np.flatnonzero(problem.is_worse(R, last))
        R[is_worse], states[is_worse] = last[is_worse], self._states[is_worse]  # or energy rises
        self.R, self._states = R, states
        fit, cost = problem.costs(self.R)
        trace = self._rest.topology.sum_parts(fit * self._area_scale)
        arap = self._rest_quadratic + self._quadratic(U) - trace
        return arap, self._rest.topology.sum_parts(self._normal_weight * cost)

    def _near_origin(self, U):
        """Return U with each component moved, so that the energy of a tiny one is no rounding."""
        return U - U[self._first[self._rest.topology.component]]

    def _quadratic(self, U):
        return 1.5 * self._rest.topology.sum_parts((U * (self._laplacian @ U)).sum(axis=1))

    def right_hand_side(self):
        """Return the right-hand side (n,3) of L U = rhs for the present rotations."""
        return sum(H @ self.R[:, :, c] for c, H in enumerate(self._scatter)) / 3.0


def area_scale(areas):
    """Return the areas (n,), which local problems are divided by; 1 where there is none."""
    return np.where(areas > SMALLEST_AREA, areas, 1.0)


def local_cubeness(areas, normals, lam):
    """Return the cubeness (n,) with which the L1 term stands beside the divided ARAP term."""
    return np.where((areas > SMALLEST_AREA) & normals.any(axis=1), lam, 0.0)
