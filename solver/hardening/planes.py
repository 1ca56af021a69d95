# SPDX-License-Identifier: GPL-3.0-or-later
"""Sides that are nearly flat become flat.

What holds the hard shape near the soft one, and the stiffness of a side along itself, leave a
shallow bulge, and edges bow. So a side whose places are all close to one plane, upright to its
direction or aslant, goes to that: the plane of least squares, without its details. Its places go
along the normal, and where sides meet, to where their planes do. What an edge moves along a side
dies away toward the middle of it.
"""

import numpy as np
from scipy.spatial import KDTree

from ..algebra import smoothstep, spreads, sums_by_group
from .open_rims import NO_RIMS, from_middles
from .rims import diagonals

NEAR = 0.01, 0.016
"""distance from the plane, the root of its mean square, relative to the root of the area: a side
that is nearer than the first goes to its plane, and one beyond the second does not..."""
OF_BARE, BARE = 1.5, (0.02, 0.04)
"""...times so much where details tilt no more than the first share of its area, but not where they
tilt the second: what is a face is not to be bent,..."""
OF_THICK, SHALLOW = 3.0, (0.06, 0.075)
"""...and times so much where, beside that, the distance is less than the first of the thickness,
but not beyond the second: a cushion becomes flat, and what is slender keeps its bends. A rim
between two flats may bulge as much, of its length, however thin the plate is"""
STRAIGHT = 0.004, 0.008
"""distance from a plane at rest, the root of its mean square, relative to the diagonal: a side that
was nearer than the first may bulge as much as a rim: posts of a fence, and what was flat"""
RIMS = 0.1, 0.15
"""distance from the plane of an open rim, relative to its radius: as `NEAR`"""
UPRIGHT = 0.01, 0.02
"""slope to the direction of the side: a plane with less than the first has none, and one with more
than the second keeps it"""
SQUARE, MOST = np.cos(np.radians(2.0)), 0.9
"""of the angle to its direction, at rest, and of the area of a side that was so: it is upright"""
FEWEST = 4
"""triangles of a side; fewer are frayed"""
CLEAR = 0.02
"""square of the tangent of half the least angle between two planes: opposite sides of a post that
tapers meet far beyond its tip"""
_FIRM = 1e3  # weight of the planes of a place beside that of staying there
_ALIKE = 0.999  # length of the mean of directions that are one
_NEAREST = 6  # places of edges that take another along
_FAR = 10.0  # between regions, so that none is nearest to those of another
_LEAST = 1e-12


def flattening(U, F, graph, side, directions, heights, is_tilted, thickness, rim, rims=NO_RIMS):
    """Return how far vertices (n,3) have to move, and how far they belong to planes (n,), 0 to 1.

    Parameters
    ----------
    U, F : arrays
        Positions (n,3) of the hard shape, and triangles (m,3).
    graph : FaceGraph
        Of these.
    side : (m,) int array
        Of the triangles, negative for those without.
    directions : (m,3) array
        That the sides face.
    heights : (n,) array
        Of the details, above the planes.
    is_tilted : (m,) bool array
        Triangles that details tilt.
    thickness : (m,) array
        Of the shape at the triangles, zero where there is none or none that counts.
    rim : (n,) array
        How far vertices belong to rims between flats, as `rims_and_flats` returns it, or to what
        was flat, see `flat_at_rest`.
    rims : as of `open_rims`, optional
    """
    n, (count, region) = len(U), graph.regions_of_sides(side)
    area = np.bincount(region, graph.areas, count)
    facing, has_one = _facing(directions, graph.areas, region, area)
    is_whole = np.bincount(region, minlength=count) >= FEWEST
    is_whole[region[side < 0]] = False
    has_one &= is_whole
    facing[~has_one] = 0.0  # they only follow their edges
    centers = U[F].mean(axis=1) - heights[F].mean(axis=1)[:, None] * facing[region]
    tilted, thick, is_rim = (
        np.bincount(region, graph.areas * values, count) / np.maximum(area, _LEAST)
        for values in (is_tilted, thickness, rim[F].min(axis=1))
    )
    is_square = np.einsum("mj,mj->m", graph.normals, facing[region]) > SQUARE
    square = np.bincount(region, graph.areas * is_square, count) > MOST * area
    normals, offsets, distance = _planes(centers, graph.areas, region, facing, square)
    size = np.sqrt(np.maximum(area, _LEAST))
    size += is_rim * (diagonals(U, F, region, count) - size)
    shares = np.where(has_one, _nearness(distance, size, tilted, thick, is_rim), 0.0)
    kept = np.flatnonzero(is_whole[region])
    numbers = np.repeat(region[kept].astype(np.int64), 3) * n + F[kept].ravel()
    of, at = np.divmod(np.unique(numbers), n)
    away = offsets[of] - _dots(normals[of], U[at] - heights[at, None] * facing[of])
    normals, shares = normals[of], shares[of]
    is_of_side = np.isin(rims[0], at)
    if is_of_side.any():
        of_rims = count + rims[1], rims[0], *_of_rims(U, *rims)
        parts = (of, at, normals, shares, away), (x[is_of_side] for x in of_rims)
        of, at, normals, shares, away = (np.concatenate(each) for each in zip(*parts, strict=True))
    moves, flat = _to_planes(n, at, normals, shares, away)
    is_edge = np.bincount(at, minlength=n)[at] > 1
    if is_edge.any() and not is_edge.all():
        one, other = region[graph.one], region[graph.other]
        length = graph.length * (one != other)
        around = sum(np.bincount(x, length, count) for x in (one, other))
        reach = np.append(area / np.maximum(around, _LEAST), 0.0)[np.minimum(of, count)]
        places = np.concatenate([U[at], _FAR * of[:, None]], axis=1)
        _take_along(moves, places, at, is_edge, normals, reach)
    return moves, flat


def flat_at_rest(V, F, graph, side):
    """Return how far vertices (n,) belong to sides that were flat, or as straight as a post.

    `V`: (n,3), rest positions. `F`, `graph`, `side`: as of `flattening`.
    """
    count, region = graph.regions_of_sides(side)
    distance = np.sqrt(spreads(V[F].mean(axis=1), graph.areas, region, count)[:, 0])
    share = smoothstep(distance / diagonals(V, F, region, count), *STRAIGHT[::-1])
    share[np.bincount(region, minlength=count) < FEWEST] = 0.0
    share[region[side < 0]] = 0.0
    at_vertices = np.zeros(len(V))
    np.maximum.at(at_vertices, F.ravel(), np.repeat(share[region], 3))
    return at_vertices


def _of_rims(U, at, rim, facing):
    """Return normals (k,3), shares (k,) and distances (k,) of the planes of rims, see `RIMS`."""
    is_upright = np.zeros(len(facing), bool)
    normals, offsets, distance = _planes(U[at], np.ones(len(at)), rim, facing, is_upright)
    away, size = from_middles(U[at], rim)
    radius = np.sqrt(np.bincount(rim, (away**2).sum(axis=1)) / size)
    shares = smoothstep(distance / np.maximum(radius, _LEAST), *RIMS[::-1])
    return normals[rim], shares[rim], offsets[rim] - _dots(normals[rim], U[at])


def _facing(directions, areas, region, area):
    """Return the mean directions (r,3) of regions, as unit vectors, and whether they have one."""
    sums = sums_by_group(areas[:, None] * directions, region, len(area))
    means = sums / np.maximum(area, _LEAST)[:, None]
    length = np.linalg.norm(means, axis=1)
    return means / np.maximum(length, _LEAST)[:, None], length > _ALIKE


def _nearness(distance, size, tilted, thick, is_rim):
    """Return how far regions (r,) of a size go to planes at such distances, 0 to 1, see `NEAR`.

    `tilted`: (r,) share of the area that details tilt. `thick`: (r,) thickness. `is_rim`: (r,).
    """
    share = distance / size
    bare = smoothstep(tilted, *BARE[::-1])
    shallow = smoothstep(distance / np.maximum(thick, _LEAST), *SHALLOW[::-1])
    shallow = bare * np.maximum(shallow, is_rim)
    near = 1.0 + (OF_BARE - 1.0) * bare + (OF_THICK - OF_BARE) * shallow
    return smoothstep(share / near, *NEAR[::-1])


def _planes(P, areas, region, facing, is_upright):
    """Return unit normals (r,3) and offsets (r,) of the planes of regions, and distances (r,).

    These are from the places, the root of the mean square. `P`: (k,3), the places of triangles with
    `areas` (k,) in a `region` (k,). `facing`: (r,3). `is_upright`: (r,) bool, those without slope.
    """
    count = len(facing)
    total = np.maximum(np.bincount(region, areas, count), _LEAST)

    def mean(values):
        return np.bincount(region, areas * values, count) / total

    across = np.cross(facing, np.eye(3)[np.abs(facing).argmin(axis=1)])
    across /= np.maximum(np.linalg.norm(across, axis=1), _LEAST)[:, None]
    axes = across, np.cross(facing, across), facing
    middle = np.stack([mean(values) for values in P.T], axis=1)
    x, y, z = (_dots(axis[region], P - middle[region]) for axis in axes)
    xx, xy, yy, xz, yz = mean(x * x), mean(x * y), mean(y * y), mean(x * z), mean(y * z)
    least = 1e-3 * (xx + yy) + _LEAST  # of a strip, the slope across it is not clear
    xx, yy = xx + least, yy + least
    a, b = np.stack([yy * xz - xy * yz, xx * yz - xy * xz]) / (xx * yy - xy * xy)
    left = z - a[region] * x - b[region] * y
    keeping = np.where(is_upright, 0.0, smoothstep(np.hypot(a, b), *UPRIGHT))
    a, b = a * keeping, b * keeping
    normals = facing - a[:, None] * axes[0] - b[:, None] * axes[1]
    normals /= np.maximum(np.linalg.norm(normals, axis=1), _LEAST)[:, None]
    return normals, _dots(normals, middle), np.sqrt(mean(left * left))


def _to_planes(n, at, normals, shares, away):
    """Return the moves (n,3) of vertices at (k,) to planes, and the largest share (n,) of each."""
    A, b, flat = np.tile(np.eye(3), (n, 1, 1)), np.zeros((n, 3)), np.zeros(n)
    weighted = _FIRM * shares[:, None] * normals
    np.add.at(A, at, weighted[:, :, None] * normals[:, None, :])
    np.add.at(b, at, (shares * away)[:, None] * weighted)
    np.maximum.at(flat, at, shares)
    moves = np.linalg.solve(A, b[:, :, None])[:, :, 0]
    several = np.flatnonzero(np.bincount(at, minlength=n) > 1)
    values, axes = np.linalg.eigh(A[several])
    is_clear = values > CLEAR * values[:, 2:]
    along = np.einsum("kji,kj->ki", axes, b[several])
    moves[several] = np.einsum("kij,kj->ki", axes, np.where(is_clear, along / values, 0.0))
    return moves, flat


def _take_along(moves, places, at, is_edge, normals, reach):
    """Move what is within regions along them, as far as their edges nearby are moved.

    `places`: (k,4), of the vertices at (k,), and their region. `reach`: (k,), where that ends.
    """
    inside, edge = np.flatnonzero(~is_edge), at[is_edge]
    count = min(_NEAREST, len(edge))
    distance, nearest = KDTree(places[is_edge]).query(places[inside], count, workers=-1)
    distance, nearest = distance.reshape(-1, count), nearest.reshape(-1, count)
    weight = 1.0 / np.maximum(distance, _LEAST) ** 2
    near = smoothstep(distance[:, 0] / np.maximum(reach[inside], _LEAST), 1.0, 0.0)
    weight *= (near / weight.sum(axis=1))[:, None]
    along = np.einsum("kj,kji->ki", weight, moves[edge][nearest])
    along -= _dots(along, normals[inside])[:, None] * normals[inside]
    np.add.at(moves, at[inside], along)


def _dots(a, b):
    return np.einsum("kj,kj->k", a, b)
