# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas and normals of the rest shape."""

import numpy as np


def triangle_areas_and_normals(V, F):
    """Return the areas (m,) and unit normals (m,3), zero where undefined, of the triangles."""
    cross = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    lengths = np.linalg.norm(cross, axis=1)
    return lengths / 2.0, cross / np.where(lengths > 0.0, lengths, 1.0)[:, None]


def areas_and_normals(V, F):
    """Return barycentric vertex areas and area-weighted unit vertex normals.

    Parameters
    ----------
    V : (n,3) float array
        Rest positions.
    F : (m,3) int array
        Triangles.

    Returns
    -------
    areas : (n,) float array
        A third of the area of the triangles around each vertex, in the unit of V squared.
    normals : (n,3) float array
        Unit normals; zero where the triangles around a vertex cancel out or have no area, which
        switches the cubic term off there.
    """
    n = len(V)
    cross = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    corners = F.ravel()
    areas = np.bincount(corners, np.repeat(np.linalg.norm(cross, axis=1) / 6.0, 3), n)
    sums = np.stack([np.bincount(corners, np.repeat(cross[:, c], 3), n) for c in range(3)], axis=1)
    lengths = np.linalg.norm(sums, axis=1)
    is_defined = lengths > 1e-12 * areas  # else rounding alone would choose the direction
    normals = np.where(is_defined[:, None], sums, 0.0) / np.where(is_defined, lengths, 1.0)[:, None]
    return areas, normals
