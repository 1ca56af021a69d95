# SPDX-License-Identifier: GPL-3.0-or-later
"""Cotangents of the corner angles, bounded on needles, slivers and triangles without area."""

import numpy as np

from .edge_vectors import double_area_vectors, edge_vectors

MAX_COTANGENT = 1e3
"""Cotangents beyond this (angles under 0.06 degrees) only harm the condition of the system."""


def cotangents(V, F):
    """Return the cotangents of the corner angles, as ``(m,3)``: column k belongs to corner k.

    A triangle with a cotangent beyond `MAX_COTANGENT` has all three scaled down together, and
    `1 / MAX_COTANGENT` added. Scaling the three by one factor keeps the triangle's Dirichlet energy
    positive semi-definite, which clamping each on its own would not; the summand ties its corners
    together even where it has no area, so that every edge-connected part stays connected in the
    Laplacian.

    `V`: (n,3), positions. `F`: (m,3) int, triangles. Returns `C`: (m,3), cotangents, without unit.

    Pinkall and Polthier, "Computing discrete minimal surfaces and their conjugates", 1993.
    """
    C = np.empty((3, len(F))).T  # as `algebra.columns` wants it
    for block, e in edge_vectors(V, F):
        dot = -np.stack([(e[k - 2] * e[k - 1]).sum(axis=0) for k in range(3)])
        double_area = np.linalg.norm(double_area_vectors(e), axis=0)
        least = np.abs(dot).max(axis=0) / MAX_COTANGENT
        scale = np.maximum(double_area, least)
        dot /= np.where(scale > 0.0, scale, 1.0)
        dot += np.where(double_area <= least, 1.0 / MAX_COTANGENT, 0.0)
        C[block] = dot.T
    return C
