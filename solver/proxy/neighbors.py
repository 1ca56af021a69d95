# SPDX-License-Identifier: GPL-3.0-or-later
"""Links between parts that are close together, so that they stay so.

From a vertex, the nearest point on any other part is linked, through its triangle. As it
is the nearest one, no third part lies between. A link is accepted

- where parts touch, intersect or almost touch: within `CONTACT`;
- within `LAYER`, where one part lies over the other like a shirt on a body: both face the same way,
  and the link is perpendicular to them.

Both are measured by the parts, not by the selection: two characters at opposite ends
of a scene are as close to their clothes as one alone. Parts that are farther apart, or side by
side at a distance, are not linked; and vertices of one part never are, however close its fingers.
Nor is a planar sheet to smaller parts, see `sheets.py`. Parts that cross and that all this leaves
apart are linked where they do.
"""

import numpy as np

from ..algebra import dot
from ..contacts.crossings import crossings
from ..mesh.components import components
from .closest_point import closest_points
from .links import links_to_triangles, no_links
from .nearest_triangles import FEW, NearestTriangles, is_in_box
from .samples import extents, surface_samples
from .sheets import is_ground, planar_sheets

CONTACT = 0.01
LAYER = 0.03
"""of the largest extent of the larger part..."""
OF_SMALLER = 20.0
"""...or of this multiple of that of the smaller one, if that is less: a ground may be endless"""
SAMPLES = 30_000
"""approximate number of linked vertices"""
DEEP = 0.25
"""of the extent of the smaller part: corners that are farther away are not linked"""
LEAST_WEIGHT = 1e-4
"""Parts connected by less, such as those without area, do not count as a single part."""

_UPRIGHT = 0.7  # cosine between a link within LAYER and the normal of the triangle
_PARALLEL = 0.5  # cosine between the normals of layers


def neighbor_links(V, F, normals, areas, part, count):
    """Return links between neighbors of different parts.

    `V`: (n,3), rest positions in the unit box. `F`: (m,3) int. `normals`: (n,3), unit normals, or
    zero. `areas`: (n,). `part`: (n,) int, connected part of each vertex, of `count` parts.
    """
    if count < 2 or not len(F):
        return no_links()
    near = _near_others(V, part, count)
    if not near.any():
        return no_links()
    corners = F.astype(np.int64)
    spacing, chosen, area = surface_samples(V, normals, areas, part, near, SAMPLES)
    sizes = extents(V, part)

    def reach(size):
        return (1.0 + 1e-9) * LAYER * _common(sizes[part[chosen]], size)

    nearest = NearestTriangles(V, corners, part, chosen, sizes, reach)
    i, triangle, barycentric, d = nearest.ways()
    share = np.zeros(len(V))
    share[chosen] = area
    weights = share[i] / np.maximum(dot(*d.T, *d.T), np.maximum(share[i], spacing[i] ** 2))
    both = np.stack([part[i], part[corners[triangle, 0]]])
    is_kept = _is_accepted(V[corners[triangle]], normals[i], sizes[both], d)
    is_kept &= (weights > LEAST_WEIGHT) & ~is_ground(sizes, planar_sheets(V, F, part), *both)
    i, triangle, barycentric = i[is_kept], triangle[is_kept], barycentric[is_kept]
    links = links_to_triangles(i, corners[triangle], barycentric, weights[is_kept])
    return links.joined(links_through(V, F, part, count, links, areas, spacing))


def _near_others(V, part, count):
    """Return which vertices (n,) may be within reach of a part that is not theirs, by boxes."""
    if count > FEW:
        return np.ones(len(V), dtype=bool)
    is_near = np.zeros(len(V), dtype=bool)
    places = np.ascontiguousarray(V.T)
    for k in range(count):
        is_own = part == k
        is_near |= ~is_own & is_in_box(places, places[:, is_own], LAYER)
    return is_near


def _is_accepted(places, normals, sizes, d):
    """Return which links (k,) to create; see the module.

    `places`: (k,3,3), of the corners of the triangles. `normals`: (k,3), of the vertices. `sizes`:
    (2,k), extents of both parts. `d`: (k,3), from the vertices to the triangles.
    """
    distance = np.linalg.norm(d, axis=1)
    a, b, c = places.transpose(1, 0, 2)
    upright = np.cross(b - a, c - a)
    upright /= np.maximum(np.linalg.norm(upright, axis=1), 1e-300)[:, None]
    is_layer = np.abs((upright * d).sum(axis=1)) > _UPRIGHT * distance
    is_layer &= (upright * normals).sum(axis=1) > _PARALLEL
    reach = np.where(is_layer, LAYER, CONTACT)
    return distance <= reach * _common(*sizes)


def _common(one, other):
    """Return the extent that counts between parts, of their own; it grows with both."""
    return np.minimum(np.maximum(one, other), OF_SMALLER * np.minimum(one, other))


def links_through(V, F, part, count, links, areas, spacing):
    """Return links where a part goes through another one that others (Links) do not connect it to.

    So does an antenna in a head, none of whose vertices is near the surface: it would stay where it
    is while the head becomes smaller. The corners of the triangles that cross are linked to the
    triangle that they cross.

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
