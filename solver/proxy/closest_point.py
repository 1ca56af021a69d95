# SPDX-License-Identifier: GPL-3.0-or-later
"""The point of a triangle that is nearest to another point."""

import numpy as np

from ..algebra import columns, dot, from_columns


def closest_points(P, A, B, C):
    """Return barycentric coordinates (k,3) of the nearest point to each P in a triangle each.

    `P`, `A`, `B`, `C`: (k,3), points, and the corners of the triangles. Fastest if they lie as by
    `algebra.by_columns`.

    The regions of a triangle as in Ericson, "Real-Time Collision Detection", 2005, 5.1.5.
    """
    ab, ac = columns(B - A), columns(C - A)
    (d1, d2), (d3, d4), (d5, d6) = (
        (dot(*ab, *way), dot(*ac, *way)) for way in (columns(P - corner) for corner in (A, B, C))
    )
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2

    def share(part, whole):
        return part / np.where(whole > 0.0, whole, 1.0)

    total = va + vb + vc
    v, w = share(vb, total), share(vc, total)
    found = np.stack([1 - v - w, v, w])
    # of edges and corners, from the last to the first, which counts where several are nearest
    edges = [
        ((va <= 0) & (d4 >= d3) & (d5 >= d6), d4 - d3, d5 - d6, 1, 2),
        ((vb <= 0) & (d2 >= 0) & (d6 <= 0), d2, -d6, 0, 2),
        ((vc <= 0) & (d1 >= 0) & (d3 <= 0), d1, -d3, 0, 1),
    ]
    for is_nearest, to_start, to_end, start, end in edges:
        rows = np.flatnonzero(is_nearest)
        part = to_start.take(rows)
        part = share(part, part + to_end.take(rows))
        found[:, rows] = 0.0
        found[start, rows], found[end, rows] = 1 - part, part
    corners = ((d6 >= 0) & (d5 <= d6), (d3 >= 0) & (d4 <= d3), (d1 <= 0) & (d2 <= 0))
    for corner, is_nearest in zip((2, 1, 0), corners, strict=True):
        rows = np.flatnonzero(is_nearest)
        found[:, rows] = 0.0
        found[corner, rows] = 1.0
    return from_columns(found)
