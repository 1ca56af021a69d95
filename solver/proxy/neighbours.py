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
Nor is a planar sheet to smaller parts, see `sheets.py`.
"""

import numpy as np

from ..algebra import by_columns, columns, dot, take
from .closest_point import closest_points
from .links import links_to_triangles, no_links
from .nearest import Nearest
from .samples import extents, surface_samples
from .sheets import is_ground

CONTACT = 0.01
LAYER = 0.03
"""of the largest extent of the larger part..."""
OF_SMALLER = 20.0
"""...or of this multiple of that of the smaller one, if that is less: a ground may be endless"""
SAMPLES = 30_000
"""approximate number of linked vertices"""
LEAST_WEIGHT = 1e-4
"""Parts connected by less, such as those without area, do not count as a single part."""
MANY = 64
"""parts, of which there are too many to look at one by one"""

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
    a, b, c = _corner_places(V, corners)
    middles = (a + b + c) / 3.0
    size = max(float(_squared(corner - middles).max()) for corner in (a, b, c)) ** 0.5
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
    weights = share[i] / np.maximum(_squared(d), np.maximum(share[i], spacing[i] ** 2))
    is_kept = _is_accepted(V, corners, normals, part, i, triangle, d) & (weights > LEAST_WEIGHT)
    is_kept &= ~is_ground(V, F, part, part[i], part[corners[triangle, 0]])
    i, triangle, barycentric = i[is_kept], triangle[is_kept], barycentric[is_kept]
    return links_to_triangles(i, corners[triangle], barycentric, weights[is_kept])


def _corner_places(V, corners):
    """Return the places (k,3) of the corners (k,3) of triangles, as `by_columns` has them."""
    places = by_columns(V)
    return [take(places, corners[:, k]) for k in range(3)]


def _squared(d):
    """Return the squared sizes (k,) of vectors (k,3)."""
    return dot(*columns(d), *columns(d))


def _near_others(points, label, count, reach):
    """Return which points (n,3) may be within reach of a part that is not theirs, by boxes."""
    if count > MANY:
        return np.ones(len(points), dtype=bool)
    is_near = np.zeros(len(points), dtype=bool)
    coordinates = np.ascontiguousarray(points.T)
    for k in range(count):
        is_own = label == k
        if is_own.any():
            is_near |= ~is_own & _is_in_box(coordinates, coordinates[:, is_own], reach)
    return is_near


def _is_in_box(points, others, reach):
    """Return which points (3,n) are within reach of the box around others (3,k)."""
    is_inside = np.ones(points.shape[1], dtype=bool)
    for here, there in zip(points, others, strict=True):
        is_inside &= (here >= there.min() - reach) & (here <= there.max() + reach)
    return is_inside


def _nearest_middles(V, chosen, part, middles, face, corners, reach):
    """Return pairs of a vertex and a triangle of another part that may be the nearest."""
    vertices, triangles = [], []
    for asks, is_asked in _comparisons(part[chosen], part[corners[face, 0]]):
        asking, asked = chosen[asks], face[is_asked]
        if not len(asked):
            continue
        asking = asking[_is_in_box(V[asking].T, middles[asked].T, reach)]
        if not len(asking):
            continue
        k = min(_CANDIDATES, len(asked))
        found = Nearest(middles[asked])(V[asking], k=k, distance_upper_bound=reach)
        found = found.reshape(len(asking), k)
        is_found = found < len(asked)
        vertices.append(np.repeat(asking, k)[is_found.ravel()])
        triangles.append(asked[found[is_found]])
    if not vertices:
        return np.empty(0, np.int64), np.empty(0, np.int64)
    return np.concatenate(vertices), np.concatenate(triangles)


def _comparisons(of_vertex, of_face):
    """Yield masks of vertices and of triangles, by their parts, that are compared with each other.

    Together they are all pairs of different parts. Each of few parts is compared with all others.
    Of many, it is used that two different numbers differ in at least one bit: for each bit, the
    vertices of parts that have it are compared with the triangles of parts that do not, and vice
    versa.
    """
    parts = np.unique(of_face)
    if len(parts) <= MANY:
        for k in parts:
            yield of_vertex != k, of_face == k
        return
    for bit in range(int(max(of_vertex.max(), parts[-1])).bit_length()):
        vertex_bit, face_bit = of_vertex >> bit & 1, of_face >> bit & 1
        for value in (0, 1):
            yield vertex_bit == value, face_bit != value


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
    a, b, c = _corner_places(V, corners[triangle])
    P = V[i]
    barycentric = closest_points(P, a, b, c)
    points = barycentric[:, :1] * a + barycentric[:, 1:2] * b + barycentric[:, 2:] * c
    d = points - P
    order = np.lexsort((triangle, _squared(d), i))
    is_first = np.ones(len(order), dtype=bool)
    is_first[1:] = i[order][1:] != i[order][:-1]
    best = order[is_first]
    return i[best], triangle[best], barycentric[best], d[best]


def _is_accepted(V, corners, normals, part, i, triangle, d):
    """Return which links to create; see the module."""
    both = extents(V, part)[np.stack([part[i], part[corners[triangle, 0]]])]
    smaller, larger = both.min(axis=0), both.max(axis=0)
    distance = np.sqrt(_squared(d))
    a, b, c = _corner_places(V, corners[triangle])
    upright = np.cross(b - a, c - a)
    upright /= np.maximum(np.linalg.norm(upright, axis=1), 1e-300)[:, None]
    is_layer = np.abs((upright * d).sum(axis=1)) > _UPRIGHT * distance
    is_layer &= (upright * normals[i]).sum(axis=1) > _PARALLEL
    reach = np.where(is_layer, LAYER, CONTACT)
    return distance <= reach * np.minimum(larger, OF_SMALLER * smaller)
