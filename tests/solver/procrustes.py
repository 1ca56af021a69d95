# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a shape has turned as a whole."""

import numpy as np


def best_rotation(U, V, areas):
    """Return the 3 x 3 matrix Q with which U @ Q, moved, is nearest to V.

    This is the orthogonal Procrustes problem (Schönemann 1966), about the centroids and weighted
    by the areas of the vertices. Where only a reflection is nearest, Q is one.
    """
    A, B = (X - np.average(X, axis=0, weights=areas) for X in (U, V))
    P, _, Rt = np.linalg.svd((A * areas[:, None]).T @ B)
    return P @ Rt


def degrees(V, U):
    """Return by how much U (n,3) is turned from V (n,3)."""
    Q = best_rotation(V, U, np.ones(len(V)))
    return np.degrees(np.arccos(np.clip((np.trace(Q) - 1) / 2, -1, 1)))
