# SPDX-License-Identifier: GPL-3.0-or-later
"""Sharp creases and corners, where a surface has no normal.

The normal of a vertex in the edge of a box lies between its two sides, and the cubic term would
turn it toward one of them: a box, which is cubic already, would lose its edges. So the crease is
ignored, and its area is given to the vertices beside it, which each have the normal of one side.
"""

import numpy as np

from ..algebra import smoothstep
from ..mesh.edge_vectors import BLOCK
from ..mesh.edges import edges_of
from ..mesh.rest_measures import cotangents, triangle_areas_and_normals

FULL = np.cos(np.radians(25.0))
"""the normal counts where those of the faces around are within 25 degrees of it, on average..."""
NONE = np.cos(np.radians(40.0))
"""...and not at all beyond 40: the edge of a box has 45"""
FLAT = np.cos(np.radians(30.0))
"""triangles at a smaller angle are of one side"""

_LEAST = 0.5  # smoothness of the corners of a triangle, together, that can speak for all of it


def cubic_shares(triangles, smooth, areas):
    """Return the area (n,) represented by the normal of each vertex, relative to its own area.

    `triangles`: Triangles. `smooth`: (n,), see `smoothness`. `areas`: (n,), barycentric areas.
    """
    corners = _corners(triangles.F)
    at_corners = smooth.take(corners)
    total = np.maximum(at_corners.sum(axis=0), _LEAST)
    given = _at_vertices(corners, at_corners * (triangles.areas / total), len(areas))
    return given / np.where(areas > 0.0, areas, 1.0)


def smoothness(F, C, measures, n):
    """Return how meaningful the normal of each of n vertices is, (n,), from 0 in a crease to 1.

    The normals of the triangles are weighted by their angles at the vertex, so that the result does
    not depend on how the sides of a box are triangulated.

    measures : as of `triangle_areas_and_normals`
    """
    areas, normals = measures
    corners = _corners(F)
    angles = np.empty(corners.shape)
    for begin in range(0, corners.shape[1], BLOCK):
        block = slice(begin, begin + BLOCK)
        angles[:, block] = _angles(C[block].T) * (areas[block] > 0.0)
    total = _at_vertices(corners, angles, n)
    sums = np.stack([_at_vertices(corners, angles * x, n) for x in normals.T], axis=1)
    coherence = np.linalg.norm(sums, axis=1) / np.where(total > 0.0, total, 1.0)
    return smoothstep(coherence, NONE, FULL)


def mute_sides(V, F):
    """Return which sides of triangles (m,3), opposite their corners, join two vertices of creases.

    Only those within a flat side of the surface: if it is narrow and all its vertices are in its
    creases, none of them has its normal.
    """
    measures = triangle_areas_and_normals(V, F)
    is_silent = smoothness(F, cotangents(V, F), measures, len(V)) < _LEAST
    a, b, c = is_silent.take(_corners(F))
    joins = np.stack([b & c, c & a, a & b], axis=1)
    rows = np.flatnonzero((a & b) | (c & (a | b)))  # of a smooth mesh next to none
    corners = F[rows]
    edges, edge = edges_of(corners[:, [1, 2, 0]].ravel(), corners[:, [2, 0, 1]].ravel(), len(V))
    count, normals = len(edges), measures[1][rows]
    sums = np.stack([np.bincount(edge, np.repeat(x, 3), count) for x in normals.T], axis=1)
    is_flat = (sums * sums).sum(axis=1) > 2.0 + 2.0 * FLAT
    is_flat &= np.bincount(edge, minlength=count) == 2
    result = np.zeros(F.shape, dtype=bool)
    result[rows] = joins[rows] & is_flat[edge].reshape(-1, 3)
    return result


def _corners(F):
    return F.T.astype(np.intp, order="C")


def _at_vertices(corners, values, n):
    return np.bincount(corners.ravel(), values.ravel(), n)


def _angles(cotangents):
    """Return angles in radians, to a hundred-thousandth.

    By arithmetic alone: NumPy's rounding of an arctangent depends on the memory alignment of its
    arrays, and a second run must have the same bits. Abramowitz and Stegun, "Handbook of
    Mathematical Functions", 1964, 4.4.49.
    """
    size = np.abs(cotangents)
    x = np.minimum(size, 1.0) / np.maximum(size, 1.0)  # the tangent of what is left to 45 degrees
    y = x * x
    arctangent = x * (
        0.9998660 + y * (-0.3302995 + y * (0.1801410 + y * (-0.0851330 + y * 0.0208351)))
    )
    acute = np.where(size > 1.0, arctangent, np.pi / 2 - arctangent)
    return np.where(cotangents >= 0.0, acute, np.pi - acute)
