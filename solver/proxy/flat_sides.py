# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat sides of hard-edged parts: they have no detail to lose, and may stretch more easily.

The walls of a letter can only turn toward the cube if its flat front gives way, and a tapered
cabin becomes a box only if its roof grows. In an organic shape the curved surface itself gives way;
a flat side holds everything around it, as strongly as if it were full of detail.
"""

import numpy as np

from ..components import components
from ..rest_measures import triangle_areas_and_normals
from .edges import faces_at_edges

STIFFNESS = 0.15
"""weight of the triangles of a flat side"""
LEAST_SHARE = 0.03
"""of the area of a part; a smaller side may be a facet of a round shape"""
COPLANAR = np.cos(np.radians(0.5))


def stiffness(V, F, part):
    """Return the factors (m,) of the weights of the triangles: less than 1 in flat sides.

    Parameters
    ----------
    V : (n,3) float array
    F : (m,3) int array
    part : (n,) int array
        Connected part of each vertex.
    """
    areas, normals = triangle_areas_and_normals(V, F)
    one, other = faces_at_edges(F, len(V))
    is_flat = (normals[one] * normals[other]).sum(axis=1) > COPLANAR
    no_triangle = np.empty((0, 3), np.int64)
    pairs = np.stack([one[is_flat], other[is_flat]], axis=1)
    count, side = components(no_triangle, len(F), pairs)
    of_part = np.bincount(part[F[:, 0]], areas)
    share = np.bincount(side, areas, count)[side] / np.maximum(of_part[part[F[:, 0]]], 1e-300)
    return np.where(share >= LEAST_SHARE, STIFFNESS, 1.0)
