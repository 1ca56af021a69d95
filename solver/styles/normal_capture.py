# SPDX-License-Identifier: GPL-3.0-or-later
"""Which way surfaces should face, shown by a ball that an artist has shaped: a normal capture.

Each vertex of the ball tells for one direction, the way it faced when the ball was round, which way
it faces now. A surface that faces so should then face alike. Between the vertices it is
interpolated linearly over the triangles of the convex hull of the directions, so that a ball as it
was asks for nothing, and a flat side of it for exactly one normal.
"""

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..algebra import sums_by_group
from ..aliases import FloatArray
from ..errors import CubicCraftError
from ..inputs import real_numbers, vectors

LEAST = 4
"""directions"""
MOST = 20_000
"""directions; of more, those near each other are merged, 1.5 degrees apart"""
_CELL = 0.025  # in which directions are merged
_LEAST_DEPTH = 0.02  # of the origin inside the hull of the directions
_OUTSIDE = -1e-9  # of a barycentric coordinate
_MOST_WALKS = 500  # from triangle to triangle
_SMALLEST = 1e-6  # of an interpolated normal, before it gets its length


class NormalCapture:
    """A map of unit vectors: directions (k,3), and which way a surface that faces so should face.

    They may be of any length; where one or its normal is zero, it is left out.

    Raises
    ------
    CubicCraftError
        There are too few of them, or they do not surround the origin.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import NormalCapture
    >>> axes = np.concatenate([np.eye(3), -np.eye(3)])
    >>> NormalCapture(axes, axes[:, [1, 0, 2]]).at(np.array([[0.0, 2.0, 0.0]]))
    array([[1., 0., 0.]])
    """

    def __init__(self, directions: ArrayLike, normals: ArrayLike):
        d, n = (vectors(x, "the vectors of a normal capture") for x in (directions, normals))
        if d.shape != n.shape:
            raise CubicCraftError("a normal capture needs one normal for each direction")
        is_usable = np.isfinite(d).all(axis=1) & np.isfinite(n).all(axis=1)
        is_usable &= d.any(axis=1) & n.any(axis=1)
        d, n = _unit(d[is_usable]), _unit(n[is_usable])
        if len(d) > MOST:
            d, n = _merged(d, n)
        if len(d) < LEAST:
            raise CubicCraftError("it has fewer than four vertices that face somewhere")
        self._directions, self._normals = d, n
        self._hull = _hull(d)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, NormalCapture) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    def __repr__(self) -> str:
        return f"NormalCapture({len(self._directions)} directions)"

    @cached_property
    def key(self) -> bytes:
        """Bytes that are the same for the same map."""
        return self._directions.tobytes() + self._normals.tobytes()

    @cached_property
    def _into_corners(self):
        """(t,3,3) from a vector to its coordinates in the corners of each triangle of the hull."""
        corners = self._directions[self._hull.simplices].swapaxes(1, 2)
        is_flat = np.abs(np.linalg.det(corners)) < 1e-14
        corners[is_flat] = np.eye(3)
        inverse = np.linalg.inv(corners)
        inverse[is_flat] = np.nan  # nothing lies in it
        return inverse

    @cached_property
    def _nearby(self):
        """A tree of the directions, and for each of them a triangle that it is a corner of."""
        from scipy.spatial import KDTree

        triangles = np.zeros(len(self._directions), np.intp)
        triangles[self._hull.simplices.ravel()] = np.repeat(np.arange(len(self._hull.simplices)), 3)
        corners = np.unique(self._hull.simplices)
        return KDTree(self._directions[corners]), corners, triangles

    def at(self, x: ArrayLike) -> FloatArray:
        """Return the unit normals (n,3) for vectors x (n,3).

        Zero for a vector without length, and where the normals around it cancel out.
        """
        x = _unit(real_numbers(x, "the directions"))
        tree, corners, triangles = self._nearby
        nearest = corners[tree.query(x)[1]]
        found = self._interpolated(x, triangles[nearest], nearest)
        sizes = np.linalg.norm(found, axis=1)
        is_defined = x.any(axis=1) & (sizes > _SMALLEST)
        return np.where(is_defined[:, None], found, 0.0) / np.where(is_defined, sizes, 1.0)[:, None]

    def _interpolated(self, x, at, nearest):
        """Walk from triangles `at` to those that the vectors point to."""
        found = self._normals[nearest]
        todo = np.arange(len(x))
        for _ in range(_MOST_WALKS):
            shares = np.einsum("nij,nj->ni", self._into_corners[at[todo]], x[todo])
            least = shares.argmin(axis=1)  # of NaN its first: out of a flat triangle by any side
            is_inside = shares[np.arange(len(todo)), least] >= _OUTSIDE
            there, corners = todo[is_inside], self._hull.simplices[at[todo[is_inside]]]
            found[there] = np.einsum("ni,nij->nj", shares[is_inside], self._normals[corners])
            todo, least = todo[~is_inside], least[~is_inside]
            if not len(todo):
                break
            at[todo] = self._hull.neighbors[at[todo], least]
        return found  # what has not arrived has the normal of its nearest direction


def targets_for(captures, numbers, strength, Q, normals):
    """Return the normals that those of a mesh are drawn to, and how strongly.

    `captures`: list of NormalCapture. `numbers`: (n,) int, which of them each vertex has.
    `strength`: (n,). `Q`: (n,3,3) or (1,3,3), orientations, from where the normals are to the frame
    of the captures. `normals`: (n,3). Returns (n,4), unit normals and strengths; all zero where
    there is nothing to face.
    """
    Q = np.broadcast_to(Q, (len(normals), 3, 3))
    found = np.zeros((len(normals), 4))
    for number, capture in enumerate(captures):
        rows = np.flatnonzero((numbers == number) & (strength > 0.0))
        seen = capture.at(np.einsum("nij,nj->ni", Q[rows], normals[rows]))
        found[rows, :3] = np.einsum("nji,nj->ni", Q[rows], seen)
        found[rows, 3] = np.where(seen.any(axis=1), strength[rows], 0.0)
    return found


def _hull(d):
    from scipy.spatial import ConvexHull, QhullError

    outside = CubicCraftError("its vertices do not surround its origin, as those of a ball do")
    try:
        hull = ConvexHull(d)
    except (QhullError, ValueError) as error:
        raise outside from error
    if hull.equations[:, 3].max() > -_LEAST_DEPTH:
        raise outside
    return hull


def _merged(d, n):
    _, cell = np.unique(np.floor(d / _CELL).astype(np.int64), axis=0, return_inverse=True)
    cell = cell.ravel()
    sums = [sums_by_group(values, cell) for values in (d, n)]
    is_usable = np.all([np.linalg.norm(x, axis=1) > _SMALLEST for x in sums], axis=0)
    return tuple(_unit(x[is_usable]) for x in sums)


def _unit(x):
    sizes = np.linalg.norm(x, axis=1, keepdims=True)
    return x / np.where(sizes > 0.0, sizes, 1.0)
