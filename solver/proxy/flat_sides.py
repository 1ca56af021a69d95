# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat sides of hard-edged parts: they have no detail to lose, and may stretch more easily.

The walls of a letter can only turn toward the cube if its flat front gives way, and a tapered
cabin becomes a box only if its roof grows. In an organic shape the curved surface itself gives way;
a flat side holds everything around it, as strongly as if it were full of detail. The faces of a
plate, such as a lid, a coin or the top of a table, hold its rim: the less of it there is, the more.
"""

import numpy as np

from ..algebra import columns, dot, smoothstep, take
from ..mesh.components import components
from .sheets import moments_of_normals

STIFFNESS = 0.15
"""weight of the triangles of a flat side"""
LEAST_SHARE = 0.03
"""of the area of a part; a smaller side may be a facet of a round shape"""
FLAT = 0.45, 0.7
"""of the area of a part in such sides: with less than the first it has all details, with more than
the second none. A window frame on a wall would else tilt the wall, and be torn by it"""
PLATE, LEAST = 0.25, 0.05
"""share of the area of a plate that does not face along its axis, with which its faces are as stiff
as any flat side; they are less with less, down to a factor for the thinnest"""
ALONG = 0.99
"""cosine between the normals of a plate's faces and its axis"""
COPLANAR = np.cos(np.radians(0.5))


def stiffness(triangles, part):
    """Return the factors (m,) of the weights of the triangles: less than 1 in flat sides.

    `triangles`: Triangles. `part`: (n,) int, connected part of each vertex.
    """
    areas, normals = triangles.areas, triangles.normals
    of_face = triangles.parts(part)
    of_part = np.bincount(of_face, areas)
    is_large = _are_large(areas, normals, triangles.edges.triangles(), of_face, of_part)
    of_plates = STIFFNESS * _of_plates(areas, normals, of_face, len(of_part))
    return np.where(is_large, of_plates, 1.0)


def _of_plates(areas, normals, of_face, count):
    """Return factors (m,): less than 1 for triangles across the axis of a plate."""
    total, moments = moments_of_normals(areas, normals, of_face, count)
    values, axes = np.linalg.eigh(moments)
    rim = 1.0 - values[:, -1] / np.maximum(total, 1e-300)
    factors = np.clip((rim / PLATE) ** 2, LEAST, 1.0)
    is_face = np.abs((normals * axes[of_face, :, -1]).sum(axis=1)) > ALONG
    return np.where(is_face, factors[of_face], 1.0)


def flat_shares(graph, part):
    """Return how far parts consist of large flat sides, from 0 to 1: they have no details.

    `graph`: FaceGraph. `part`: (m,) int, of its triangles, as what is returned.
    """
    of_part = np.bincount(part, graph.areas)
    is_large = _are_large(graph.areas, graph.normals, (graph.one, graph.other), part, of_part)
    flat = np.bincount(part, graph.areas * is_large) / np.maximum(of_part, 1e-300)
    return smoothstep(flat, *FLAT)[part]


def _are_large(areas, normals, pairs, of_face, of_part):
    """Return which triangles (m,) are of a flat side that is no facet of a round shape.

    `pairs`: two (k,) int, triangles that share an edge. `of_face`: (m,) int, the part of each.
    `of_part`: (p,) area.
    """
    one, other = pairs
    is_flat = dot(*columns(take(normals, one)), *columns(take(normals, other))) > COPLANAR
    count, side = components(np.stack([one[is_flat], other[is_flat]], axis=1), len(areas))
    share = np.bincount(side, areas, count)[side] / np.maximum(of_part[of_face], 1e-300)
    return share >= LEAST_SHARE
