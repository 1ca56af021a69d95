# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step in NumPy: runs everywhere, and is what the tests compare Taichi with."""

import numpy as np

from ..rotation_fit import fit_rotations, orthonormalize

SMALLEST_AREA = 1e-30
"""in the unit box; less is no area, and would overflow in 32 bit"""


class NumpyLocalStep:
    """Rotations from positions, and the right-hand side of the global step from rotations.

    Parameters
    ----------
    rest : RestMesh
    lam : (n,) float64 array
        Cubeness per vertex.
    Q : (n,3,3) or (1,3,3) float64 array
        Orientation of the cube: maps a vector into the cube's frame.
    options : AdmmOptions

    Attributes
    ----------
    R : (n,3,3) array
        Rotations, the identity at first.
    resolution : float
        Distance in the unit box below which everything is rounding.
    """

    device = "numpy"
    compile_seconds = 0.0
    resolution = 1e-9

    def __init__(self, rest, lam, Q, options):
        self._rest = rest
        self._lam = local_cubeness(rest, lam)
        self._Q = np.broadcast_to(Q, (len(lam), 3, 3))
        self._options = options
        matrices = rest.matrices
        self._laplacian = matrices.matrix(matrices.laplacian)
        self._gather = [matrices.matrix(matrices.gather[:, c]) for c in range(3)]
        self._scatter = [matrices.matrix(matrices.scatter[:, c]) for c in range(3)]
        self._area_scale = area_scale(rest.areas)
        _, first = np.unique(rest.component, return_index=True)
        self._origins = rest.V[first][rest.component]
        self._rest_quadratic = self._quadratic(rest.V)
        n = len(rest.V)
        self.R = np.tile(np.eye(3), (n, 1, 1))
        self._z = np.einsum("nij,nj->ni", self._Q, rest.normals)
        self._u = np.zeros((n, 3))
        self._rho = np.full(n, options.rho_start)

    def start_from(self, R):
        """Begin with rotations (n,3,3)."""
        self.R[:] = R
        self._z[:] = np.einsum("nij,njk,nk->ni", self._Q, R, self._rest.normals)

    def update(self, U):
        """Fit all rotations to the positions U (n,3).

        Returns
        -------
        arap, cubic : (component_count,) arrays
            Energies of the positions with these rotations.
        """
        S = np.stack([H @ U for H in self._gather], axis=1)
        S_scaled = S / self._area_scale[:, None, None]
        last = orthonormalize(self.R)
        self.R = self._fit(S_scaled, last)
        worse = self._objective(self.R, S_scaled) > self._objective(last, S_scaled)
        self.R[worse] = last[worse]  # so that no iteration raises the energy
        trace = np.einsum("nij,nji->n", self.R, S)
        arap = self._rest_quadratic + self._quadratic(U) - self._rest.sum_parts(trace)
        cubic = self._rest.sum_parts(self._lam * self._rest.areas * self._l1(self.R))
        return arap, cubic

    def _quadratic(self, U):
        U = U - self._origins  # else a tiny part far away would lose its digits
        return 1.5 * self._rest.sum_parts((U * (self._laplacian @ U)).sum(axis=1))

    def right_hand_side(self):
        """Return the right-hand side (n,3) of L U = rhs for the present rotations."""
        return sum(H @ self.R[:, :, c] for c, H in enumerate(self._scatter)) / 3.0

    def _cube_normals(self, R, active=slice(None)):
        rotated = np.einsum("nij,nj->ni", R, self._rest.normals[active])
        return np.einsum("nij,nj->ni", self._Q[active], rotated)

    def _l1(self, R):
        return np.abs(self._cube_normals(R)).sum(axis=1)

    def _objective(self, R, S):
        return self._lam * self._l1(R) - np.einsum("nij,nji->n", R, S)

    def _fit(self, S, R):
        """Run the ADMM; each vertex is left alone once it has converged."""
        R = R.copy()
        plain = self._lam == 0.0
        R[plain] = fit_rotations(S[plain], R[plain])
        active = np.flatnonzero(~plain)
        for _ in range(self._options.max_iterations):
            if not len(active):
                break
            R[active], is_done = self._admm_iteration(S[active], R[active], active)
            active = active[~is_done]
        return R

    def _admm_iteration(self, S, R, active):
        o = self._options
        n, Q = self._rest.normals[active], self._Q[active]
        z, u, rho = self._z[active], self._u[active], self._rho[active]
        pull = np.einsum("nji,nj->ni", Q, z - u) * rho[:, None]
        R = fit_rotations(S + n[:, :, None] * pull[:, None, :], R)
        x = self._cube_normals(R, active)
        threshold = (self._lam[active] / rho)[:, None]
        z_new = np.sign(x + u) * np.maximum(np.abs(x + u) - threshold, 0.0)
        u = u + x - z_new
        primal = np.linalg.norm(z_new - x, axis=1)
        dual = rho * np.linalg.norm(z_new - z, axis=1)
        size = np.maximum(np.linalg.norm(x, axis=1), np.linalg.norm(z_new, axis=1))
        force = rho * np.linalg.norm(u, axis=1)
        is_done = (primal <= o.absolute + o.relative * size) & (
            dual <= o.absolute + o.relative * force
        )
        change = np.ones(len(rho))
        change[primal > o.balance * dual] = o.factor
        change[dual > o.balance * primal] = 1.0 / o.factor
        rho_new = np.where(is_done, rho, np.clip(rho * change, o.rho_min, o.rho_max))
        self._z[active] = z_new
        self._u[active] = u * (rho / rho_new)[:, None]
        self._rho[active] = rho_new
        return R, is_done


def area_scale(areas):
    """Return what the local problem of each vertex is divided by, (n,): its area.

    Vertices without area have no cubic term, and any positive number will do.
    """
    return np.where(areas > SMALLEST_AREA, areas, 1.0)


def local_cubeness(rest, lam):
    """Return the cubeness (n,) with which the L1 term stands beside the divided ARAP term."""
    return np.where(rest.areas > SMALLEST_AREA, lam, 0.0)
