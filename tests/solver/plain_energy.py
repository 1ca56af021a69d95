# SPDX-License-Identifier: GPL-3.0-or-later
"""The energy by its definition, in loops: slow, and sharing nothing with the solver."""

import numpy as np


def plain_energy(V, F, U, R, lam, Q):
    """Return the ARAP and the cubic energy of rotations R and positions U, as they stand."""
    arap = 0.0
    areas = np.zeros(len(V))
    normals = np.zeros((len(V), 3))
    for f in F:
        area_vector = np.cross(V[f[1]] - V[f[0]], V[f[2]] - V[f[0]]) / 2
        for k in range(3):
            i, j, o = f[k], f[(k + 1) % 3], f[(k + 2) % 3]
            a, b = V[i] - V[o], V[j] - V[o]
            cot = a @ b / np.linalg.norm(np.cross(a, b))
            d, d_new = V[j] - V[i], U[j] - U[i]
            for corner in f:
                residual = R[corner] @ d - d_new
                arap += cot / 2 * residual @ residual
            areas[i] += np.linalg.norm(area_vector) / 3
            normals[i] += area_vector
    cubic = 0.0
    for i in range(len(V)):
        length = np.linalg.norm(normals[i])
        if length > 0:
            cubic += lam * areas[i] * np.abs(Q @ R[i] @ normals[i] / length).sum()
    return arap, cubic
