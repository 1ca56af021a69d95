# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures of a result as a sculpture.

V, U: (n,3) positions at rest and after, in world space; F: (m,3) triangles of everything together.
Lengths are relative to the size: the largest side of the bounding box at rest.
"""

import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree
from mathutils.geometry import barycentric_transform
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

SAME_PLACE = 1e-6
"""of the size, within which vertices are at one place"""
SEEN = 5e-4
"""of the size: triangles that cross by less, as slivers where two planes meet, look whole"""
REACH = 0.01
"""of the size, within which vertices of different parts are neighbours"""
RAYS = ((0.31, 0.22, 0.925), (-0.57, 0.74, 0.36), (0.13, -0.83, -0.54))
"""skew directions, so that a ray rarely meets an edge of a mesh that follows the axes"""


def size_of(V):
    """Return the largest side of the bounding box."""
    return float(np.ptp(V, axis=0).max())


def welded(V, F):
    """Return F (m,3) with the first vertex at each place in place of all that are there."""
    pairs = cKDTree(V).query_pairs(SAME_PLACE * size_of(V), output_type="ndarray")
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), (len(V), len(V)))
    _, place = connected_components(graph, directed=False)
    _, first = np.unique(place, return_index=True)
    return first[place][F]


def part_of(V, F, is_welded=True):
    """Return the number of parts and the part (n,) of each vertex, -1 without a triangle.

    Triangles with a common edge are of one part; a common vertex alone does not join parts.

    `is_welded`: a seam, where edges are doubled, does not end a part.
    """
    corners = welded(V, F) if is_welded else F
    edges = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=2), axis=2)
    _, edge = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)
    triangle = np.repeat(np.arange(len(F)), 3)
    side = len(F) + edge.ravel()
    count = side.max() + 1
    graph = coo_matrix((np.ones(len(side)), (triangle, side)), (count, count))
    number, label = connected_components(graph, directed=False)
    part = np.full(len(V), -1)
    part[F] = label[: len(F), None]
    return number, part


def drift(V, U, F, is_welded=True):
    """Return how far neighbours of different parts moved against each other: 99th percentile.

    The neighbour of a vertex is the nearest one of another part. 0 where there are no neighbours.
    """
    size, (_, part) = size_of(V), part_of(V, F, is_welded)
    pairs = cKDTree(V).query_pairs(REACH * size, output_type="ndarray")
    a, b = part[pairs].T
    pairs = pairs[(a != b) & (a >= 0) & (b >= 0)]
    if not len(pairs):
        return 0.0
    pairs = np.concatenate([pairs, pairs[:, ::-1]])
    distance = np.linalg.norm(V[pairs[:, 0]] - V[pairs[:, 1]], axis=1)
    pairs = pairs[np.lexsort([distance, pairs[:, 0]])]
    i, j = pairs[np.unique(pairs[:, 0], return_index=True)[1]].T
    moved = U - V
    return float(np.percentile(np.linalg.norm(moved[i] - moved[j], axis=1), 99) / size)


def seat(V, U, F, reach=REACH):
    """Return the drift of vertices against the nearest place of another part, on its triangles.

    The 99th percentile, as `drift`; for coarse parts, whose vertices are far from each other. Of
    places within a reach, a share of the size.
    """
    size, (_, part) = size_of(V), part_of(V, F)
    moves = []
    for number in np.unique(part[F]):
        own = F[part[F[:, 0]] == number]
        tree = BVHTree.FromPolygons(V.tolist(), own.tolist())
        for i in np.flatnonzero((part != number) & (part >= 0)):
            place, _, index, _ = tree.find_nearest(Vector(V[i]), reach * size)
            if index is not None:
                a, b, c = map(Vector, V[own[index]])
                after = barycentric_transform(place, a, b, c, *map(Vector, U[own[index]]))
                moves.append(np.linalg.norm(U[i] - after - (V[i] - place)))
    return float(np.percentile(moves, 99) / size) if moves else 0.0


def tear(V, U):
    """Return how far vertices at one place came apart at most."""
    size = size_of(V)
    pairs = cKDTree(V).query_pairs(SAME_PLACE * size, output_type="ndarray")
    gap = np.linalg.norm(U[pairs[:, 0]] - U[pairs[:, 1]], axis=1)
    return float(gap.max(initial=0.0) / size)


def angle_to_axes(U, F):
    """Return the mean angle in degrees of normals to the nearest axis, each counted by its area."""
    normal = np.cross(U[F[:, 1]] - U[F[:, 0]], U[F[:, 2]] - U[F[:, 0]])
    doubled_area = np.linalg.norm(normal, axis=1)
    cosine = np.abs(normal).max(axis=1) / np.maximum(doubled_area, 1e-300)
    return float(np.degrees(np.arccos(np.minimum(cosine, 1)) @ doubled_area / doubled_area.sum()))


def turn(V, U, F=None):
    """Return the angle in degrees by which the whole has turned.

    Each vertex counts alike, or with F by its area: what is meshed finely does not count for more.
    """
    weights = np.ones(len(V)) if F is None else vertex_areas(V, F)
    a, b = (X - np.average(X, axis=0, weights=weights) for X in (V, U))
    rotation, _ = Rotation.align_vectors(b, a, weights)
    return float(np.degrees(rotation.magnitude()))


def shift(V, U, F):
    """Return how far the centroid of the surface at rest has moved."""
    return float(np.linalg.norm(np.average(U - V, axis=0, weights=vertex_areas(V, F))) / size_of(V))


def vertex_areas(V, F):
    """Return the area (n,) of each vertex: a third of those of its triangles."""
    area = np.linalg.norm(np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), axis=1) / 2
    return np.bincount(F.ravel(), np.repeat(area / 3, 3), len(V))


def volume(U, F):
    """Return the signed volume: positive where the normals point out."""
    a, b, c = (U[F[:, k]] - U.mean(axis=0) for k in range(3))
    return float(np.sum(a * np.cross(b, c)) / 6)


def share_inside(points, V, F):
    """Return the share of points (k,3) inside a closed surface, which may cross itself.

    A point is inside where the surface winds around it; rays count how often it is left.
    """
    tree = BVHTree.FromPolygons(V.tolist(), F.tolist())
    step, rays = 1e-6 * size_of(V), [Vector(ray).normalized() for ray in RAYS]
    inside = [
        np.median([_winding(tree, Vector(point), ray, step) for ray in rays]) > 0
        for point in points.tolist()
    ]
    return float(np.mean(inside))


def _winding(tree, point, ray, step):
    """Return how often more the ray leaves the surface than it enters."""
    winding = 0
    while True:
        place, normal, index, _ = tree.ray_cast(point, ray)
        if index is None:
            return winding
        winding += 1 if normal.dot(ray) > 0 else -1
        point = place + step * ray


def share_behind(points, V, F):
    """Return the share of points (k,3) behind an open sheet: where its normals do not point."""
    tree = BVHTree.FromPolygons(V.tolist(), F.tolist())
    behind = []
    for point in map(Vector, points.tolist()):
        place, normal, *_ = tree.find_nearest(point)
        behind.append(normal.dot(point - place) < 0)
    return float(np.mean(behind))


def movement(V, U, of=slice(None)):
    """Return how far the vertices of a subset moved at most."""
    return float(np.linalg.norm(U[of] - V[of], axis=1).max() / size_of(V))


def new_crossings(V, U, F):
    """Return how many triangles are seen to cross others, and crossed none at rest."""
    rest, after = (_crossing_pairs(V, X, F) for X in (V, U))
    one, other = np.asarray(U, dtype=np.float64)[F[after]].swapaxes(0, 1)
    least = SEEN * size_of(V)
    is_seen = _straddles(one, other, least) & _straddles(other, one, least)
    return len(np.setdiff1d(after[is_seen], rest))


def _crossing_pairs(V, U, F):
    tree = BVHTree.FromPolygons(U.tolist(), F.tolist())
    pairs = np.array(tree.overlap(tree), dtype=int).reshape(-1, 2)
    pairs = pairs[pairs[:, 0] < pairs[:, 1]]
    corners = welded(V, F)
    meets = (corners[pairs[:, 0], :, None] == corners[pairs[:, 1], None, :]).any(axis=(1, 2))
    return pairs[~meets]


def _straddles(one, other, least):
    """Return which triangles (k,3,3) reach beyond the planes of others on both sides.

    What lies in one plane and touches them overlaps as well, in 32 bit.
    """
    normals = np.cross(other[:, 1] - other[:, 0], other[:, 2] - other[:, 0])
    heights = np.einsum("kij,kj->ki", one - other[:, :1], normals)
    least = least * np.linalg.norm(normals, axis=1)
    return (heights.min(axis=1) < -least) & (heights.max(axis=1) > least)


def limbs_turn(V, U, parts):
    """Return the largest angle in degrees by which a limb has turned.

    `parts`: sequence of (n,) bool, the vertices of each limb, which is longer than thick.
    """
    ways = [[np.linalg.eigh(np.cov(X[part].T))[1][:, 2] for part in parts] for X in (V, U)]
    cosines = [abs(one @ other) for one, other in zip(*ways, strict=True)]
    return float(np.degrees(np.arccos(np.clip(cosines, 0.0, 1.0))).max())
