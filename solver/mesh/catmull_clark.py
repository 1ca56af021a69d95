# SPDX-License-Identifier: GPL-3.0-or-later
"""The smooth surface of a cage, by the rules of Catmull and Clark."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..aliases import FloatArray, IntArray
from ..values import Value
from .edges import edges_of

FULL = 10.0
"""sharpness of a border, which is more than any level that is computed"""


@dataclass(frozen=True, eq=False, repr=False)
class Cage(Value):
    """The faces of a mesh, and how sharp their edges and corners stay on the smooth surface."""

    sizes: IntArray
    """(f,) int number of corners of each face"""
    corners: IntArray
    """(c,) int vertices of the faces, one face after the other"""
    creases: IntArray
    """(k,2) int ends of edges"""
    sharpness: FloatArray
    """(k,) for how many levels each of them stays sharp"""
    stiffness: FloatArray
    """(n,) for how many levels each vertex stays in place"""
    keeps_corners: bool = False
    """whether vertices of one face stay in place"""

    @property
    def faces(self) -> IntArray:
        """(c,) int face of each corner."""
        return np.repeat(np.arange(len(self.sizes)), self.sizes)

    @property
    def after(self) -> IntArray:
        """(c,) int the next corner in the face of each."""
        after, end = np.arange(1, len(self.corners) + 1), np.cumsum(self.sizes)
        after[end - 1] = end - self.sizes
        return after

    @property
    def edges(self) -> IntArray:
        """(e,2) int ends of the edges of the faces."""
        return edges_of(self.corners, self.corners[self.after], len(self.stiffness))[0]

    def count(self, levels: int) -> int:
        """Return the number of vertices after as many levels, edges of one face aside."""
        vertices, corners, faces = len(self.stiffness), len(self.corners), len(self.sizes)
        for _ in range(levels):
            vertices, corners, faces = vertices + corners // 2 + faces, 4 * corners, corners
        return vertices


def catmull_clark(cage: Cage) -> tuple[Any, Any, Cage]:
    """Return one level of subdivision.

    The n' new vertices are the n of the cage, then those of its edges, then those of its faces.

    `cage`: of n vertices. Those in no face stay where they are. Returns `smooth`: (n',n) scipy
    csr_matrix, from positions of the cage to those of the surface; `flat`: (n',n) scipy csr_matrix,
    the same without smoothing: to the middles of edges and faces; `cage`: Cage, of the new
    vertices, with a quad for each corner, which begins there and faces the same way.

    Catmull and Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes",
    1978; creases by DeRose, Kass and Truong, "Subdivision Surfaces in Character Animation", 1998.
    Where sharpness ends between two levels, the rules of both are mixed, as in Blender.
    """
    import scipy.sparse as sp

    n, faces, after = len(cage.stiffness), cage.faces, cage.after
    edges, edge = edges_of(cage.corners, cage.corners[after], n)
    sharp = _sharpness(cage, edges, edge)

    def incidence(rows, columns, shape):
        return sp.csr_matrix((np.ones(len(rows)), (rows, columns)), shape=shape)

    f, e = len(cage.sizes), len(edges)
    at_faces = sp.diags(1.0 / cage.sizes) @ incidence(faces, cage.corners, (f, n))
    ends = incidence(np.repeat(np.arange(e), 2), edges.ravel(), (e, n))
    middles = 0.5 * ends
    beside = incidence(edge, faces, (e, f))
    now = np.minimum(sharp, 1.0)
    at_edges = sp.diags(1.0 - now) @ (0.5 * middles + 0.25 * beside @ at_faces)
    at_edges = at_edges + sp.diags(now) @ middles
    of_vertex = incidence(cage.corners, faces, (n, f))
    at_vertices = _at_vertices(cage, at_faces, middles, of_vertex, ends.T.tocsr(), sharp)
    smooth = sp.vstack([at_vertices, at_edges, at_faces]).tocsr()
    flat = sp.vstack([sp.identity(n), middles, at_faces]).tocsr()
    before = np.empty_like(edge)
    before[after] = edge
    quads = np.stack([cage.corners, n + edge, n + e + faces, n + before], axis=1)
    kept = np.flatnonzero(sharp > 1.0)
    halves = np.concatenate([np.stack([edges[kept, k], n + kept], axis=1) for k in range(2)])
    stiffness = np.concatenate([np.maximum(cage.stiffness - 1.0, 0.0), np.zeros(e + f)])
    finer = Cage(
        np.full(len(quads), 4),
        quads.ravel(),
        halves,
        np.tile(sharp[kept] - 1.0, 2),
        stiffness,
        cage.keeps_corners,
    )
    return smooth, flat, finer


def _sharpness(cage, edges, edge):
    """Return that of each edge (e,); one that is not between two faces is a border."""
    n = len(cage.stiffness)
    sharp = np.zeros(len(edges))
    key = edges[:, 0] * n + edges[:, 1]
    given = cage.creases.min(axis=1) * n + cage.creases.max(axis=1)
    place = np.minimum(np.searchsorted(key, given), len(key) - 1)
    is_there = key[place] == given  # not of an edge without faces
    np.maximum.at(sharp, place[is_there], cage.sharpness[is_there])
    sharp[np.bincount(edge, minlength=len(edges)) != 2] = FULL
    return sharp


def _at_vertices(cage, at_faces, middles, faces_of, edges_of_vertex, sharp):
    """Return the rule (n,n) of the vertices of the cage.

    `at_faces`, `middles`: (f,n) and (e,n) csr_matrix. `faces_of`, `edges_of_vertex`: (n,f) and
    (n,e) csr_matrix, the faces and the edges of each vertex, as ones. `sharp`: (e,).
    """
    import scipy.sparse as sp

    n = len(cage.stiffness)
    faces, edges = (np.diff(each.indptr) for each in (faces_of, edges_of_vertex))
    is_loose = faces == 0
    k = np.maximum(edges, 1)
    stay = sp.identity(n).tocsr()
    smooth = sp.diags(1.0 / (k * np.maximum(faces, 1))) @ (faces_of @ at_faces)
    smooth = smooth + sp.diags(2.0 / (k * k)) @ (edges_of_vertex @ middles)
    smooth = smooth + sp.diags((k - 3.0) / k)

    def rule(is_sharp, is_stiff):
        """Return which rule holds, 0, 1 or 2, and its matrix."""
        those = edges_of_vertex @ sp.diags(is_sharp.astype(float))
        count = edges_of_vertex @ is_sharp.astype(float)
        which = np.where((count > 2) | is_stiff | is_loose, 2, (count == 2).astype(int))
        if cage.keeps_corners:
            which[faces == 1] = 2
        each = smooth, 0.5 * stay + 0.25 * (those @ middles), stay
        return which, sum(sp.diags((which == k).astype(float)) @ m for k, m in enumerate(each))

    now, at_once = rule(sharp > 0.0, cage.stiffness > 0.0)
    then, later = rule(sharp > 1.0, cage.stiffness > 1.0)
    ends, stops = (sharp > 0.0) & (sharp <= 1.0), (cage.stiffness > 0.0) & (cage.stiffness <= 1.0)
    total = edges_of_vertex @ np.where(ends, sharp, 0.0) + np.where(stops, cage.stiffness, 0.0)
    share = total / np.maximum(edges_of_vertex @ ends.astype(float) + stops, 1.0)
    share[now == then] = 1.0
    return sp.diags(share) @ at_once + sp.diags(1.0 - share) @ later
