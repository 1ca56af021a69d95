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
"""

import numpy as np
from scipy.spatial import KDTree

from .closest_point import closest_points
from .links import links_to_triangles, no_links
from .samples import extents, surface_samples

CONTACT = 0.01
LAYER = 0.03
"""of the largest extent of the larger part..."""
OF_SMALLER = 20.0
"""...or of this multiple of that of the smaller one, if that is less: a ground may be endless"""
SAMPLES = 30_000
"""approximate number of linked vertices"""
LEAST_WEIGHT = 1e-4
"""Parts connected by less, such as those without area, do not count as a single part."""

_CANDIDATES = 6  # triangles, by their centers, among which the nearest is searched
_UPRIGHT = 0.7  # cosine between a link within LAYER and the normal of the triangle
_PARALLEL = 0.5  # cosine between the normals of layers


def neighbour_links(V, F, normals, areas, part, count):
    """Return links between neighbours of different parts.

    Parameters
    ----------
    V : (n,3) float array
        Rest positions in the unit box.
    F : (m,3) int array
    normals : (n,3) float array
        Unit normals, or zero.
    areas : (n,) float array
    part : (n,) int array
        Connected part of each vertex, of `count` parts.
    """
    if count < 2 or not len(F):
        return no_links()
    corners = F.astype(np.int64)
    middles = V[corners].mean(axis=1)
    size = float(np.linalg.norm(V[corners] - middles[:, None], axis=2).max())
    near = _near_others(V, part, count, LAYER)
    face = np.flatnonzero(_near_others(middles, part[corners[:, 0]], count, LAYER + 2 * size))
    if not near.any() or not len(face):
        return no_links()
    spacing, chosen, area = surface_samples(V, normals, areas, part, near, SAMPLES)
    i, triangle = _nearest_middles(V, chosen, part, middles, face, corners, LAYER + size)
    if not len(i):
        return no_links()
    share = np.zeros(len(V))
    share[chosen] = area
    i, triangle, barycentric, d = _nearest_triangles(V, corners, i, triangle)
    weights = share[i] / np.maximum((d * d).sum(axis=1), np.maximum(share[i], spacing[i] ** 2))
    is_kept = _is_accepted(V, corners, normals, part, i, triangle, d) & (weights > LEAST_WEIGHT)
    i, triangle, barycentric = i[is_kept], triangle[is_kept], barycentric[is_kept]
    return links_to_triangles(i, corners[triangle], barycentric, weights[is_kept])


def _near_others(points, label, count, reach):
    """Return which points (n,3) may be within reach of a part that is not theirs, by boxes."""
    if count > 64:
        return np.ones(len(points), dtype=bool)
    boxes = [points[label == k] for k in range(count)]
    is_near = np.zeros(len(points), dtype=bool)
    for k, own in enumerate(boxes):
        if len(own):
            inside = (points >= own.min(axis=0) - reach) & (points <= own.max(axis=0) + reach)
            is_near |= inside.all(axis=1) & (label != k)
    return is_near


def _nearest_middles(V, chosen, part, middles, face, corners, reach):
    """Return pairs of a vertex and a triangle of another part that may be the nearest.

    Two different numbers differ in at least one bit, so for each bit, the vertices of parts that
    have it are compared with the triangles of parts that do not, and vice versa.
    """
    of_vertex, of_face = part[chosen], part[corners[face, 0]]
    vertices, triangles = [], []
    for bit in range(int(part.max()).bit_length()):
        vertex_bit, face_bit = of_vertex >> bit & 1, of_face >> bit & 1
        for value in (0, 1):
            asking, asked = chosen[vertex_bit == value], face[face_bit != value]
            if not len(asking) or not len(asked):
                continue
            tree = KDTree(middles[asked], balanced_tree=False, compact_nodes=False)
            k = min(_CANDIDATES, len(asked))
            _, found = tree.query(V[asking], k=k, distance_upper_bound=reach, workers=-1)
            found = found.reshape(len(asking), k)
            is_found = found < len(asked)
            vertices.append(np.repeat(asking, k)[is_found.ravel()])
            triangles.append(asked[found[is_found]])
    if not vertices:
        return np.empty(0, np.int64), np.empty(0, np.int64)
    return np.concatenate(vertices), np.concatenate(triangles)


def _nearest_triangles(V, corners, i, triangle):
    """Of pairs, keep the one with the nearest triangle of each vertex.

    Returns
    -------
    i, triangle : (k,) int arrays
    barycentric : (k,3) array
        Of the nearest point.
    d : (k,3) array
        From the vertex to it.
    """
    a, b, c = (V[corners[triangle, k]] for k in range(3))
    barycentric = closest_points(V[i], a, b, c)
    points = barycentric[:, :1] * a + barycentric[:, 1:2] * b + barycentric[:, 2:] * c
    d = points - V[i]
    order = np.lexsort((triangle, (d * d).sum(axis=1), i))
    is_first = np.ones(len(order), dtype=bool)
    is_first[1:] = i[order][1:] != i[order][:-1]
    best = order[is_first]
    return i[best], triangle[best], barycentric[best], d[best]


def _is_accepted(V, corners, normals, part, i, triangle, d):
    """Return which links to create; see the module."""
    both = extents(V, part)[np.stack([part[i], part[corners[triangle, 0]]])]
    smaller, larger = both.min(axis=0), both.max(axis=0)
    distance = np.linalg.norm(d, axis=1)
    a, b, c = (V[corners[triangle, k]] for k in range(3))
    upright = np.cross(b - a, c - a)
    upright /= np.maximum(np.linalg.norm(upright, axis=1), 1e-300)[:, None]
    is_layer = np.abs((upright * d).sum(axis=1)) > _UPRIGHT * distance
    is_layer &= (upright * normals[i]).sum(axis=1) > _PARALLEL
    reach = np.where(is_layer, LAYER, CONTACT)
    return distance <= reach * np.minimum(larger, OF_SMALLER * smaller)
