# SPDX-License-Identifier: GPL-3.0-or-later
"""What is nearest between two triangles: a corner and the other triangle, or two edges.

Each is a vector between two points, sum_k c_k v_k over four vertices, as `proxy/links.py` has it:
(-1, b_1, b_2, b_3) from a corner to a triangle, (s-1, -s, 1-t, t) from an edge to an edge.
"""

import numpy as np

from ..proxy.closest_point import closest_points

EDGES = ((0, 1), (1, 2), (2, 0))


def features(V, A, B):
    """Return the 15 ways between triangles with corners A and B (k,3), at positions V (n,3).

    Returns `vertices`: (k,15,4) int; `coefficients`: (k,15,4).
    """
    vertices, coefficients = [], []
    for one, other in ((A, B), (B, A)):
        places = [V[other[:, k]] for k in range(3)]
        for corner in one.T:
            vertices.append(np.column_stack([corner, other]))
            b = closest_points(V[corner], *places)
            coefficients.append(np.column_stack([-np.ones(len(b)), b]))
    for i, j in EDGES:
        for k, m in EDGES:
            ends = np.column_stack([A[:, i], A[:, j], B[:, k], B[:, m]])
            s, t = closest_on_edges(*(V[end] for end in ends.T))
            vertices.append(ends)
            coefficients.append(np.column_stack([s - 1.0, -s, 1.0 - t, t]))
    return np.stack(vertices, axis=1), np.stack(coefficients, axis=1)


def closest_on_edges(A, B, C, D):
    """Return where (k,) from A to B and from C to D (k,3) two edges are nearest, from 0 to 1.

    As in Ericson, "Real-Time Collision Detection", 2005, 5.1.9.
    """
    u, v, w = B - A, D - C, A - C
    a, e, b = (u * u).sum(axis=1), (v * v).sum(axis=1), (u * v).sum(axis=1)
    c, f = (u * w).sum(axis=1), (v * w).sum(axis=1)
    whole = a * e - b * b
    s = np.clip(_share(b * f - c * e, whole), 0.0, 1.0)
    t = np.clip(_share(b * s + f, e), 0.0, 1.0)
    return np.clip(_share(b * t - c, a), 0.0, 1.0), t


def _share(part, whole):
    return np.where(whole > 0.0, part / np.where(whole > 0.0, whole, 1.0), 0.0)
