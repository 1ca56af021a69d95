# SPDX-License-Identifier: GPL-3.0-or-later
"""Convex bodies with flat sides: what a ball becomes.

A body W around the origin has the support function ``h(x) = max over s in W of s.x``. As the cost
of a unit normal x it is lowest, with a kink, where x is normal to a side of W, so that minimizing
it makes surfaces flat that face these ways (Wulff, Zeitschrift fuer Krystallographie 34, 1901).
The cube with half size 1 has the cost |x|_1 of Liu and Jacobson's cubic stylization.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import BoolArray, FloatArray, IntArray
from ..errors import CubicCraftError
from ..inputs import real_numbers, vectors

SAME = 1e-7
"""relative; distances below are rounding"""
ROUNDED = 1e-5
"""relative distance of vertices that are one, where directions come from meshes of 32 bits"""
EXACT = 1e-7
"""the same where they are known to all bits"""
NARROWEST = 1e-3
"""of the distances from the origin to the sides, relative to the size of the body"""
STRONGEST = 4.0
"""distance of the nearest side; without this limit, bodies that are almost balls would have any"""


@dataclass(frozen=True, eq=False, repr=False)
class Polytope:
    """A convex body with flat sides that has the origin inside: see `from_directions`."""

    normals: FloatArray
    """(f,3) unit normals of the facets"""
    offsets: FloatArray
    """(f,) distances of the facets from the origin"""
    vertices: FloatArray
    """(v,3)"""
    rounding: float = ROUNDED
    """relative distance below which vertices are one"""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Polytope) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    def __repr__(self) -> str:
        return f"Polytope({len(self.normals)} sides, {len(self.vertices)} vertices)"

    @cached_property
    def key(self) -> bytes:
        """Bytes that are the same for the same body."""
        return self.normals.tobytes() + self.offsets.tobytes()

    @cached_property
    def incidence(self) -> BoolArray:
        """(v,f) bool, which vertex lies on which facet."""
        distances = self.vertices @ self.normals.T - self.offsets
        return np.abs(distances) < 2.0 * self.rounding * self.radius

    @cached_property
    def edges(self) -> IntArray:
        """(e,2) int, pairs of vertices."""
        shared = self.incidence.astype(int) @ self.incidence.T
        return np.argwhere(np.triu(shared >= 2, 1))

    @property
    def edge_facets(self) -> IntArray:
        """(e,2) int, the two facets of each edge."""
        both = self.incidence[self.edges[:, 0]] & self.incidence[self.edges[:, 1]]
        return np.argsort(~both, axis=1, kind="stable")[:, :2]

    @property
    def facet_areas(self) -> FloatArray:
        """(f,) areas of the facets: of the triangles between their edges and their middles."""
        a, b = self.vertices[self.edges[:, 0]], self.vertices[self.edges[:, 1]]
        areas = np.zeros(len(self.normals))
        for facets in self.edge_facets.T:
            middle = self.middles[facets]
            np.add.at(areas, facets, np.linalg.norm(np.cross(a - middle, b - middle), axis=1) / 2)
        return areas

    @property
    def middles(self) -> FloatArray:
        """(f,3) means of the vertices of each facet, which lie inside it."""
        return (self.incidence.T @ self.vertices) / self.incidence.sum(axis=0)[:, None]

    @cached_property
    def radius(self) -> float:
        """Largest distance of a vertex from the origin."""
        return float(np.linalg.norm(self.vertices, axis=1).max())

    def scaled(self, factor: float) -> Polytope:
        """Return the body in another size: its costs are as many times those of this one."""
        return replace(self, offsets=factor * self.offsets, vertices=factor * self.vertices)

    def turned(self, turn: FloatArray) -> Polytope:
        """Return the body whose cost at x is that of this one at ``turn x``; it may mirror."""
        return replace(self, normals=self.normals @ turn, vertices=self.vertices @ turn)

    def cost(self, x: FloatArray) -> FloatArray:
        """Return the support function (n,) of vectors x (n,3)."""
        return (x @ self.vertices.T).max(axis=1)


def from_directions(
    directions: ArrayLike, offsets: ArrayLike | None = None, rounding: float = ROUNDED
) -> Polytope:
    """Return the body of all points y with ``d.y <= offset`` for each direction d.

    `directions`: (k,3), of any length except zero. `offsets`: (k,), optional, positive; by default
    all sides are equally far away. `rounding`: relative distance below which vertices are one:
    corners where more than three sides meet. Returns Polytope, in the size in which the same
    cubeness looks about as strong as with the cube, because costs differ as much. Sides that do not
    touch the body are left out. Raises CubicCraftError: the directions do not enclose the origin:
    the body would have no end.
    """
    d = vectors(directions, "the directions of a form")
    sizes = np.linalg.norm(d, axis=1)
    r = np.ones(len(d)) if offsets is None else real_numbers(offsets, "the offsets of a form")
    if not (np.isfinite(d).all() and np.isfinite(r).all() and (sizes > 0.0).all() and len(d)):
        raise CubicCraftError("the directions of a form must be finite, and not zero")
    if not (r > NARROWEST * r.max()).all():
        raise CubicCraftError("the sides of a form must lie around its origin")
    d, r = d / sizes[:, None], r / r.min()
    d, r = _distinct(d, r)
    if not encloses_origin(d):
        raise CubicCraftError("the directions of a form must point to all sides")
    halfspaces = np.column_stack([d, -r])
    spatial = _scipy_spatial()
    try:
        vertices = spatial.HalfspaceIntersection(halfspaces, np.zeros(3)).intersections
    except spatial.QhullError as error:
        raise CubicCraftError(f"the form has no volume: {str(error).splitlines()[0]}") from error
    size = np.linalg.norm(vertices, axis=1).max()
    vertices = vertices[_first_of_alike(vertices, rounding * size)]
    body = Polytope(d, r, vertices, rounding)
    touching = body.incidence.sum(axis=0) >= 3
    d, r = d[touching], r[touching]
    spread = body.radius / r.min() - 1.0
    strength = min((np.sqrt(3.0) - 1.0) / max(spread, SAME), STRONGEST)
    return replace(body, normals=d, offsets=r).scaled(strength / r.min())


def from_points(points: ArrayLike) -> Polytope:
    """Return the convex hull of points, about their origin.

    `points`: (n,3). Returns Polytope, as `from_directions`. Raises CubicCraftError: the points are
    flat, or the origin does not lie inside.
    """
    normals, offsets, _ = hull_planes(vectors(points, "the points of a form"))
    return from_directions(normals, offsets)


def hull_planes(points):
    """Return unit normals, offsets and triangles of a hull, or raise as `from_points`."""
    spatial = _scipy_spatial()
    try:
        hull = spatial.ConvexHull(points)
    except (spatial.QhullError, ValueError) as error:
        raise CubicCraftError("a form needs at least four points that are not flat") from error
    normals, offsets = hull.equations[:, :3], -hull.equations[:, 3]
    if not (offsets > NARROWEST * np.abs(points).max()).all():
        raise CubicCraftError("the origin of the form must lie inside it")
    return normals, offsets, hull.simplices


def minkowski_sum(a, b):
    """Return the body whose costs are the sums of those of two Polytopes."""
    points = (a.vertices[:, None] + b.vertices).reshape(-1, 3)
    planes = _scipy_spatial().ConvexHull(points).equations
    offsets = -planes[:, 3]
    body = from_directions(planes[:, :3], offsets, max(a.rounding, b.rounding))
    return body.scaled(offsets.min() / body.offsets.min())


def _distinct(d, r):
    """Return directions without those that are there already, each with its nearest side."""
    order = np.argsort(r, kind="stable")
    _, first = np.unique(np.round(d[order] / SAME / 10).astype(np.int64), axis=0, return_index=True)
    kept = order[np.sort(first)]
    # Rounding may part two that are alike.
    chosen = np.sort(kept[_first_of_alike(d[kept], 10 * SAME)])
    return d[chosen], r[chosen]


def encloses_origin(d):
    """Return whether directions (k,3) point to all sides, and not only just."""
    spatial = _scipy_spatial()
    try:
        return bool((spatial.ConvexHull(d).equations[:, 3] < -NARROWEST).all())
    except (spatial.QhullError, ValueError):
        return False


def _scipy_spatial():
    """Import it when a body is made: the names are needed before SciPy is known to be there."""
    import scipy.spatial

    return scipy.spatial


def _first_of_alike(points, distance):
    """Return the numbers (k,) of points (n,3), without those that are at an earlier one."""
    kept = []
    for number, point in enumerate(points):
        if not kept or np.abs(points[kept] - point).max(axis=1).min() > distance:
            kept.append(number)
    return np.array(kept)
