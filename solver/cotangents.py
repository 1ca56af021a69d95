# SPDX-License-Identifier: GPL-3.0-or-later
"""Cotangents of the corner angles, bounded on needles, slivers and triangles without area."""

import numpy as np

MAX_COTANGENT = 1e3
"""Cotangents beyond this (angles under 0.06 degrees) only harm the condition of the system."""


def cotangents(V, F):
    """Return the cotangents of the corner angles, as ``(m,3)``: column k belongs to corner k.

    A triangle with a cotangent beyond `MAX_COTANGENT` has all three scaled down together, and
    `1 / MAX_COTANGENT` added. Scaling the three by one factor keeps the triangle's Dirichlet energy
    positive semi-definite, which clamping each on its own would not; the summand ties its corners
    together even where it has no area, so that every edge-connected part stays connected in the
    Laplacian.

    Parameters
    ----------
    V : (n,3) float array
        Positions.
    F : (m,3) int array
        Triangles.

    Returns
    -------
    C : (m,3) float array
        Cotangents, without unit.

    Notes
    -----
    Pinkall and Polthier, "Computing discrete minimal surfaces and their conjugates", 1993.
    """
    e = [V[F[:, (k + 2) % 3]] - V[F[:, (k + 1) % 3]] for k in range(3)]  # e[k] is opposite corner k
    dot = -np.stack([(e[(k + 1) % 3] * e[(k + 2) % 3]).sum(1) for k in range(3)], axis=1)
    double_area = np.linalg.norm(np.cross(e[0], e[1]), axis=1)
    least = np.abs(dot).max(axis=1) / MAX_COTANGENT
    bounded = double_area <= least
    scale = np.maximum(double_area, least)
    C = dot / np.where(scale > 0.0, scale, 1.0)[:, None]
    C[bounded] += 1.0 / MAX_COTANGENT
    return C
