# SPDX-License-Identifier: GPL-3.0-or-later
"""Links to the opposite side of a part, so that limbs, walls and necks keep their thickness.

For a vertex, the largest ball inside the surface that touches it also touches the opposite side.
It is found by shrinking (Ma, Bae and Choi, "3D medial axis point approximation using nearest
neighbors and the normal field", 2012): the vertex nearest to the center of a ball gives the radius
of the next one.

A link is accepted between a vertex and the vertex that its ball ends at, if

- the part encloses a volume: the holes in it are small, its triangles agree on what is outside, and
  edges of more than two triangles are few. Open sheets have no other side;
- the ball lies inside: normals that point inward (a part of negative volume) are turned around
  first, so nothing is linked across the gap between the fingers of an inverted hand;
- both contacts are seen from the center of the ball under more than `LEAST_ANGLE`: else the ball
  has ended at its own neighborhood, as in every convex corner;
- the surfaces face away from each other.

As next to no vertex of the part lies inside the ball, a link does not cross another wall of it.
"""

import numpy as np

from ..algebra import columns, dot, sums_by_group
from .links import links_between
from .nearest import Nearest
from .samples import surface_samples

LEAST_ANGLE = np.radians(90.0)
STRENGTH = 2.7
"""of a link of solidity 1, in areas per squared distance"""
SAMPLES = 6000
"""approximate number of linked vertices; each represents the area around it"""
MOST_POINTS = 200_000
"""that the balls are measured against"""
MOST_HOLES = 0.25
"""of the area of a part; more is an open sheet. A teapot without its lid is none, a bowl is"""
MOST_FAULTS = 0.05
"""share of edges with inconsistent triangles, or more than two"""
FACING = 0.9
"""least cosine between a link and the normal at either end"""
INEXACTNESS = 0.1
"""of the nearest vertex: in the middle of a ball, all are equally near"""

_ROUNDS = 12
_MANY = 3  # points for each chosen one; of fewer, both ways cost more than the second alone
_SETTLED = 0.99  # a ball that shrinks by less has come to its end


def thickness_links(V, normals, areas, part, outward):
    """Return links of solidity 1 to the opposite side.

    `V`: (n,3), rest positions in the unit box. `normals`: (n,3), unit normals, or zero. `areas`:
    (n,). `part`: (n,) int, connected part of each vertex. `outward`: (n,), its `outward_sign`.
    """
    normals = outward[:, None] * normals
    pairs = facing_pairs(V, normals, areas, part)
    is_linked = np.zeros(int(part.max()) + 1, dtype=bool)
    is_linked[part[pairs[0]]] = True
    normals = np.where(is_linked[part][:, None], 0.0, normals)
    if normals.any():  # in a ball as large as the box, both sides of a thin plate are as near
        others = facing_pairs(V, normals, areas, part, inexactness=0.0)
        pairs = map(np.concatenate, zip(pairs, others, strict=True))
    return links_between(*pairs)


def facing_pairs(
    V, normals, areas, part, count=SAMPLES, most=MOST_POINTS, least=FACING, inexactness=INEXACTNESS
):
    """Return pairs of vertices on opposite sides of a part, and weights of links between them.

    `V`: (n,3), rest positions in the unit box. `normals`: (n,3), unit normals away from the side on
    which the balls are, or zero for none. `areas`: (n,). `part`: (n,) int. `count`: int,
    approximate number of vertices to start from. `most`: int, number of vertices that the balls are
    measured against. `least`: cosine between a link and the normals at both ends. `inexactness`: of
    what is nearest, beside its distance. Returns `i`, `j`: (k,) int; `weights`: (k,).
    """
    is_asked = normals.any(axis=1)
    points = np.flatnonzero(is_asked)
    if len(points) < 4:
        return points[:0], points[:0], areas[:0]
    points = points[:: -(-len(points) // most)]
    spacing, chosen, area = surface_samples(V, normals, areas, part, is_asked, count)
    i, j = _opposite(V, normals, part, chosen, points, inexactness)
    is_facing = facing(V, normals, i, j) > least
    i, j = i[is_facing], j[is_facing]
    share = np.zeros(len(V))
    share[chosen] = area
    distance = np.linalg.norm(V[j] - V[i], axis=1)
    return i, j, STRENGTH * share[i] / np.maximum(distance, spacing[i]) ** 2


def _opposite(V, normals, part, chosen, points, inexactness):
    """Return the vertices whose balls end at an opposite side, and those at which they end."""
    place = V.copy()
    place[:, 0] += 10.0 * part  # farther apart than any ball is wide
    end, radius = np.full(len(chosen), -1), np.full(len(chosen), 0.5)
    if len(points) > _MANY * len(chosen):  # a part of the points is enough to approach the end
        _shrink(place, normals, chosen, chosen, end, radius, inexactness)
    _shrink(place, normals, chosen, points, end, radius, inexactness)
    has_end = end >= 0
    return chosen[has_end], end[has_end]


def _shrink(place, normals, chosen, points, end, radius, inexactness):
    """Shrink balls at chosen vertices (c,) until no other point is inside, in place.

    `end`: (c,) int, the vertex that each ball ends at, -1 while there is none on an opposite side.
    `radius`: (c,).
    """
    nearest_of = Nearest(place[points])
    p, n = place[chosen], normals[chosen]
    todo = np.arange(len(chosen))
    for _ in range(_ROUNDS):
        center = p[todo] - radius[todo, None] * n[todo]
        q = points[nearest_of(center, eps=inexactness)]
        d = place[q] - p[todo]
        squared, depth = (d * d).sum(axis=1), -(d * n[todo]).sum(axis=1)
        is_other = (q != chosen[todo]) & (depth > 0.0)
        shrunk = squared / np.where(is_other, 2.0 * depth, 1.0)
        # half the angle between both contacts, from the center: |d| / 2r
        sine = np.sqrt(squared) / np.maximum(2.0 * shrunk, 1e-300)
        is_seen = is_other & (sine > np.sin(LEAST_ANGLE / 2))
        # in a round tube all around are equally near: the opposite one stays the end
        goes_on = is_seen & (shrunk < _SETTLED * radius[todo])
        is_first = is_seen & (end[todo] < 0)  # also of a part that is as thick as the unit box
        end[todo[is_first]] = q[is_first]
        todo, q, shrunk = todo[goes_on], q[goes_on], shrunk[goes_on]
        end[todo], radius[todo] = q, shrunk
        if not len(todo):
            break


def facing(V, normals, i, j):
    """Return how far normals at i and j (k,) face away from each other: the lesser cosine (k,)."""
    d = V[j] - V[i]
    length = np.maximum(np.linalg.norm(d, axis=1), 1e-300)
    return np.minimum((normals[j] * d).sum(axis=1), -(normals[i] * d).sum(axis=1)) / length


def outward_sign(triangles, part):
    """Return for each part 1 if its normals point outward, -1 if inward, 0 if it has no inside.

    Holes are closed by triangles to the center of their borders. Parts that are mostly hole, or
    whose triangles are inconsistent, have no inside.
    """
    count = int(part.max(initial=-1)) + 1
    V, edges = triangles.V, triangles.edges
    number = edges.number.ravel()
    uses = edges.uses
    balance = np.bincount(number, np.where(edges.is_backward.ravel(), -1.0, 1.0))
    owner = part[edges.lower]
    is_border = uses == 1
    is_fault = ~is_border & ((uses > 2) | (balance != 0.0))
    faults = np.bincount(owner, is_fault, count) / np.maximum(
        np.bincount(owner, minlength=count), 1
    )
    holes, volume_of_holes = _holes(V, edges, is_border, part, count)
    of_face, face_areas = triangles.parts(part), triangles.areas
    area = np.bincount(of_face, face_areas, count)
    height = dot(*columns(V).take(triangles.F[:, 0], axis=1), *triangles.normals.T)
    volume = np.bincount(of_face, face_areas * height, count) / 3.0 + volume_of_holes
    is_solid = (holes < MOST_HOLES * area) & (faults < MOST_FAULTS) & (area > 0.0)
    return np.where(is_solid, np.sign(volume), 0.0)


def _border(edges, is_border):
    """Return the ends (b,) of edges (e,) in the direction of their triangles."""
    is_open = is_border[edges.number]
    number, is_backward = edges.number[is_open], edges.is_backward[is_open]
    lower, upper = edges.lower[number], edges.upper[number]
    return np.where(is_backward, upper, lower), np.where(is_backward, lower, upper)


def _holes(V, edges, is_border, part, count):
    """Return area and volume (count,) of the fans that close the borders (e,) of each part."""
    start, end = _border(edges, is_border)
    vertices, rim = edges.rims
    loop = rim[np.searchsorted(vertices, start)]
    middle = (sums_by_group(V[start], loop) / np.bincount(loop)[:, None])[loop]
    a, b = V[end], V[start]  # against the direction of the triangles
    area = np.linalg.norm(np.cross(b - a, middle - a), axis=1) / 2.0
    volume = (a * np.cross(b, middle)).sum(axis=1) / 6.0
    return tuple(np.bincount(part[start], values, count) for values in (area, volume))
