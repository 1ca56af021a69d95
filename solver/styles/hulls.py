# SPDX-License-Identifier: GPL-3.0-or-later
"""The convex hull of many points as a body with few sides."""

import numpy as np

from ..errors import CubicCraftError
from ..mesh.rest_measures import triangle_areas_and_normals
from .clusters import directions_of
from .polytope import from_directions, from_points, hull_planes

MANY_POINTS = 20_000
"""of more, the hull of the outermost is taken"""
_WAYS = 1000
"""directions in which a point may be outermost"""
_BLOCK = 5_000
_FEW_PLANES = 500
"""the exact hull is made of no more; triangles of one side have one"""


def simple_hull(points, most):
    """Return the hull of points, about their origin, with at most so many sides.

    Where the hull has more, its sides face the directions that most of its area faces, and touch
    the points. Of very many points, corners that are outermost in a narrow range of directions only
    may be left out, but the sides touch all points.

    `points`: (n,3). `most`: int. Returns Polytope. Raises CubicCraftError: as `from_points`.
    """
    points = np.asarray(points, dtype=np.float64)
    outer = _outermost(points) if len(points) > MANY_POINTS else points
    normals, _, triangles = hull_planes(outer)
    if len(np.unique(np.round(normals, 5), axis=0)) <= _FEW_PLANES:
        body = from_points(outer)
        normals, areas = body.normals, body.facet_areas
        if len(normals) <= most and outer is points:
            return body
    else:
        areas, _ = triangle_areas_and_normals(outer, triangles)
    d = normals if len(normals) <= most else directions_of(normals, areas, most)
    return from_directions(d, (points @ d.T).max(axis=0))


def spiral(count):
    """Return evenly spread unit vectors (count,3), on a spiral."""
    k = np.arange(count) + 0.5
    z, angles = 1.0 - 2.0 * k / count, np.pi * (1.0 + np.sqrt(5.0)) * k
    radii = np.sqrt(1.0 - z * z)
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles), z])


def _outermost(points):
    if not np.isfinite(points).all():
        raise CubicCraftError("a form needs at least four points that are not flat")
    ways = spiral(_WAYS)
    kept = points[:0]
    for begin in range(0, len(points), _BLOCK):
        some = np.concatenate([kept, points[begin : begin + _BLOCK]])
        kept = some[np.unique((ways @ some.T).argmax(axis=1))]
    return kept
