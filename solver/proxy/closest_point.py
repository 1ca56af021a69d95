# SPDX-License-Identifier: GPL-3.0-or-later
"""The point of a triangle that is nearest to another point."""

import numpy as np

from ..algebra import columns, dot, from_columns


def closest_points(P, A, B, C):
    """Return barycentric coordinates (k,3) of the nearest point to each P in a triangle each.

    P, A, B, C : (k,3) float arrays
        Points, and the corners of the triangles. Fastest if they lie as by `algebra.by_columns`.

    The regions of a triangle as in Ericson, "Real-Time Collision Detection", 2005, 5.1.5.
    """
    ab, ac = columns(B - A), columns(C - A)
    (d1, d2), (d3, d4), (d5, d6) = (
        (dot(*ab, *way), dot(*ac, *way)) for way in (columns(P - corner) for corner in (A, B, C))
    )
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2
    zero, one = np.zeros(len(P)), np.ones(len(P))

    def share(part, whole):
        return part / np.where(whole > 0.0, whole, 1.0)

    on_ab, on_ac = share(d1, d1 - d3), share(d2, d2 - d6)
    on_bc = share(d4 - d3, (d4 - d3) + (d5 - d6))
    total = va + vb + vc
    cases = [
        ((d1 <= 0) & (d2 <= 0), (one, zero, zero)),
        ((d3 >= 0) & (d4 <= d3), (zero, one, zero)),
        ((d6 >= 0) & (d5 <= d6), (zero, zero, one)),
        ((vc <= 0) & (d1 >= 0) & (d3 <= 0), (1 - on_ab, on_ab, zero)),
        ((vb <= 0) & (d2 >= 0) & (d6 <= 0), (1 - on_ac, zero, on_ac)),
        ((va <= 0) & (d4 >= d3) & (d5 >= d6), (zero, 1 - on_bc, on_bc)),
    ]
    v, w = share(vb, total), share(vc, total)
    inside = (1 - v - w, v, w)
    is_case = [case for case, _ in cases]
    return from_columns([np.select(is_case, [b[k] for _, b in cases], inside[k]) for k in range(3)])
