# SPDX-License-Identifier: GPL-3.0-or-later
"""Links where a part goes through another one and none of its vertices is near the surface.

So does an antenna in a head: it would stay where it is while the head becomes smaller. The corners
of the triangles that cross are linked to the triangle that they cross, unless both parts hold
together already.
"""

import numpy as np

from ..algebra import dot
from ..contacts.crossings import crossings
from ..mesh.components import components
from .closest_point import closest_points
from .links import links_to_triangles, no_links
from .nearest_triangles import FEW
from .samples import extents
from .sheets import is_ground, planar_sheets

DEEP = 0.25
"""of the extent of the smaller part: corners that are farther away are not linked"""


def links_through(V, F, part, count, links, areas, spacing):
    """Return links between parts that cross and that others (Links) do not connect.

    `V`: (n,3) float, rest positions in the unit box. `F`: (m,3) int. `part`: (n,) int, connected
    part of each vertex, of `count` parts. `areas`, `spacing`: (n,), of the vertices, and the
    distance between them.
    """
    group = components(part[links.pairs()], count)[1]
    of_face = group[part[F[:, 0]]]
    is_asked = of_face != np.bincount(of_face).argmax()
    if count <= FEW and is_asked.any():
        is_asked &= _is_near(V, F, group, part, of_face)
    pairs = crossings(V, F, is_asked)
    pairs = pairs[of_face[pairs[:, 0]] != of_face[pairs[:, 1]]]
    if not len(pairs):
        return no_links()
    own, triangle = np.concatenate([pairs, pairs[:, ::-1]]).T
    i, triangle = F[own].ravel().astype(np.int64), np.repeat(triangle, 3)
    corners = F[triangle].astype(np.int64)
    barycentric = closest_points(V[i], *V[corners].swapaxes(0, 1))
    d = np.einsum("kc,kcj->kj", barycentric, V[corners]) - V[i]
    squared = dot(*d.T, *d.T)
    both = np.stack([part[i], part[corners[:, 0]]])
    sizes = extents(V, part)
    is_kept = squared <= (DEEP * sizes[both].min(axis=0)) ** 2
    is_kept &= ~is_ground(sizes, planar_sheets(V, F, part), *both)
    order = np.lexsort((triangle, squared, both[1], i))
    order = order[is_kept[order]]
    keys = both[:, order][1] + count * i[order]
    kept = order[np.unique(keys, return_index=True)[1]]  # the nearest of each part
    weights = areas[i] / np.maximum(squared, np.maximum(areas[i], spacing[i] ** 2))
    return links_to_triangles(i[kept], corners[kept], barycentric[kept], weights[kept])


def _is_near(V, F, group, part, of_face):
    """Return which triangles (m,) are in the box around a part of another group."""
    low, high = V[F].min(axis=1), V[F].max(axis=1)
    is_near = np.zeros(len(F), dtype=bool)
    for number, own in enumerate(group):
        places = V[part == number]
        is_in = (low <= places.max(axis=0)).all(axis=1) & (high >= places.min(axis=0)).all(axis=1)
        is_near |= is_in & (of_face != own)
    return is_near
