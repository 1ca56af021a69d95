# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat sides of hard-edged parts: they have no detail to lose, and may stretch more easily.

The walls of a letter can only turn toward the cube if its flat front gives way, and a tapered
cabin becomes a box only if its roof grows. In an organic shape the curved surface itself gives way;
a flat side holds everything around it, as strongly as if it were full of detail.
"""

import numpy as np

from ..algebra import columns, dot, take
from ..mesh.components import components

STIFFNESS = 0.15
"""weight of the triangles of a flat side"""
LEAST_SHARE = 0.03
"""of the area of a part; a smaller side may be a facet of a round shape"""
COPLANAR = np.cos(np.radians(0.5))


def stiffness(triangles, part):
    """Return the factors (m,) of the weights of the triangles: less than 1 in flat sides.

    Parameters
    ----------
    triangles : Triangles
    part : (n,) int array
        Connected part of each vertex.
    """
    areas, normals = triangles.areas, triangles.normals
    one, other = triangles.edges.triangles()
    is_flat = dot(*columns(take(normals, one)), *columns(take(normals, other))) > COPLANAR
    no_triangle = np.empty((0, 3), np.int64)
    pairs = np.stack([one[is_flat], other[is_flat]], axis=1)
    count, side = components(no_triangle, len(areas), pairs)
    of_face = triangles.parts(part)
    of_part = np.bincount(of_face, areas)
    share = np.bincount(side, areas, count)[side] / np.maximum(of_part[of_face], 1e-300)
    return np.where(share >= LEAST_SHARE, STIFFNESS, 1.0)
