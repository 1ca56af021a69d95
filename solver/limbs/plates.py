# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates, such as wings, fins and blades: they lie as they did, however aslant that is.

In the frame of the object, what is thin and aslant would crumple: neither of its sides is near to
one of the cube. So each of its planes has a frame of its own, along its normal. A wall that closes
around something, as that of a hexagonal pot, has none: it becomes square.
"""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import dijkstra

from ..algebra import spreads, sums_by_group
from ..mesh.components import components
from ..proxy.samples import extents
from .limbs import Limbs

FOLD = np.cos(np.radians(25.0))
"""between the triangles of one plane..."""
RIM = 0.5
"""...which bend by less than so many radians within a thickness, else it is a rim that is round"""
EVEN, MOST = np.cos(np.radians(30.0)), 0.8
"""between a plane and its normal, in so much of the area"""
THIN, SHARE = 0.27, 0.8
"""thickness beside the smaller extent of a plane, in so much of its area,..."""
OPEN = 0.5
"""...or so much of its outline is the border of the surface: a sheet has no thickness"""
WALL, LEAST = 0.08, 0.5
"""thickness beside the extent of a part: what is thinner is a wall, and if plates are less than so
much of that, they are the bottom of a bowl"""


def with_plates(limbs, V, F, graph, skin, part, thickness):
    """Return Limbs in which plates are pieces, along their normals.

    `V`: (n,3), in the unit box. `F`: (m,3) int. `graph`: FaceGraph. `skin`: SpokesAndRims.
    `part`: (n,) int. `thickness`: (n,), infinite where it is unknown.
    """
    thick = thickness[F].min(axis=1)
    number, normals = _plates(V, F, graph, thick)
    of_face = part[F[:, 0]]
    is_wall = (thick < WALL * extents(V, part)[of_face]) | np.isinf(thick)
    number = _without_bowls(number, graph.areas, of_face, is_wall)
    plate = _at_vertices(number, graph.areas, F, len(V))
    if not (plate >= 0).any():
        return limbs
    plate = _with_rims(plate, skin, V, thickness)
    rows = np.flatnonzero(plate >= 0)
    shape = len(V), len(normals)
    shares = sp.csr_matrix((np.ones(len(rows)), (rows, plate[rows])), shape=shape)
    return limbs.replaced(plate >= 0, Limbs(normals, shares))


def _plates(V, F, graph, thick):
    """Return the plate (m,) int of each triangle, -1 for none, and their normals (s,3).

    thick : (m,) array
    """
    areas, normals = graph.areas, graph.normals
    cosine = (normals[graph.one] * normals[graph.other]).sum(axis=1)
    is_joined = (cosine > FOLD) & ~_is_round(graph, cosine, thick)
    count, plane = graph.regions(is_joined)
    total = np.bincount(plane, areas, count) + 1e-300
    of_plane = sums_by_group(areas[:, None] * normals, plane, count)
    of_plane /= np.maximum(np.linalg.norm(of_plane, axis=1), 1e-300)[:, None]
    width = _widths(V[F].mean(axis=1), areas, plane, count)
    is_even = (normals * of_plane[plane]).sum(axis=1) > EVEN
    even, thin = (
        np.bincount(plane, areas * is_so, count) for is_so in (is_even, thick < THIN * width[plane])
    )
    border, inner = _outlines(V, graph, is_joined, plane, count)
    is_thin = (thin > SHARE * total) | (border > OPEN * (border + inner))
    is_plate = (even > MOST * total) & is_thin
    is_plate &= ~_is_closed(plane, is_plate, graph, cosine)
    return np.where(is_plate, np.cumsum(is_plate) - 1, -1)[plane], of_plane[is_plate]


def _is_round(graph, cosine, thick):
    """Return over which pairs (k,) of triangles there is a rim that is round."""
    bend = np.arccos(np.clip(cosine, -1.0, 1.0)) / graph.distance
    thinner = np.minimum(thick[graph.one], thick[graph.other])
    return bend * np.where(np.isfinite(thinner), thinner, 0.0) > RIM


def _without_bowls(number, areas, part, is_wall):
    """Return plates (m,) of triangles, without those of parts of which most of the walls are none.

    `part`: (m,) int. `is_wall`: (m,) bool.
    """
    plates, walls = (np.bincount(part, areas * is_so) for is_so in (number >= 0, is_wall))
    return np.where((plates >= LEAST * walls)[part], number, -1)


def _outlines(V, graph, is_joined, plane, count):
    """Return how much of the outlines of planes (count,) is a border of the surface, and is not."""
    edges = graph.edges
    length = np.linalg.norm(V[edges.upper] - V[edges.lower], axis=1)
    of_corner = np.where(edges.uses == 1, length, 0.0)[edges.number]
    border = np.bincount(np.tile(plane, 3), of_corner.ravel(), count)
    ends = np.concatenate([plane[graph.one], plane[graph.other]])
    inner = np.bincount(ends, np.tile(np.where(is_joined, 0.0, graph.length), 2), count)
    return border, inner


def _widths(places, weight, group, count):
    """Return the smaller extents (count,) of flat groups of places (k,3), with areas as weights."""
    lengths = np.sqrt(12.0 * np.maximum(spreads(places, weight, group, count)[:, 1:], 1e-300))
    total = np.bincount(group, weight, count)
    return np.minimum(lengths[:, 0], total / lengths[:, 1])  # a rim may turn corners


def _is_closed(plane, is_plate, graph, cosine):
    """Return which of the planes (s,) are, with those they meet at folds, all around something."""
    one, other = plane[graph.one], plane[graph.other]
    is_fold = (one != other) & is_plate[one] & is_plate[other] & (cosine > -0.5)
    pairs = np.unique(np.sort(np.stack([one, other], axis=1)[is_fold], axis=1), axis=0)
    count, group = components(pairs, len(is_plate))
    planes = np.bincount(group, minlength=count)
    return (np.bincount(group[pairs[:, 0]], minlength=count) >= planes)[group]


def _at_vertices(number, areas, F, n):
    """Return which number (n,) most of the area around each vertex has, of those of triangles."""
    corners, of_corner = F.ravel(), np.repeat(number, 3)
    keys, at = np.unique(np.stack([corners, of_corner], axis=1), axis=0, return_inverse=True)
    total = np.bincount(at.ravel(), np.repeat(areas, 3))
    order = np.argsort(total, kind="stable")
    result = np.full(n, -1)
    result[keys[order, 0]] = keys[order, 1]
    return result


def _with_rims(plate, skin, V, thickness):
    """Return plates (n,) with what is no farther from each than it is thick: its rim, if round."""
    row = np.repeat(np.arange(len(V), dtype=np.int32), np.diff(skin.indptr))
    lengths = np.linalg.norm(V[row] - V[skin.indices], axis=1) + 1e-9
    mesh = skin.matrix(lengths)
    thick = np.where(np.isfinite(thickness), thickness, 0.0)
    found = np.flatnonzero(plate >= 0)
    away, _, source = dijkstra(
        mesh, indices=found, min_only=True, return_predecessors=True, limit=thick[found].max()
    )
    rows = np.flatnonzero((plate < 0) & (source >= 0))
    rows = rows[away[rows] < thick[source[rows]]]
    result = plate.copy()
    result[rows] = plate[source[rows]]
    return result
