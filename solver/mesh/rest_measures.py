# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas and normals of the rest shape, and the cotangents of its corner angles."""

import numpy as np

from ..aliases import FloatArray, IntArray
from .edge_vectors import double_area_vectors, edge_vectors

MAX_COTANGENT = 1e3
"""Cotangents beyond this (angles under 0.06 degrees) only harm the condition of the system."""


def triangle_areas_and_normals(V: FloatArray, F: IntArray) -> tuple[FloatArray, FloatArray]:
    """Return the areas (m,) and unit normals (m,3) of triangles F (m,3) at positions V (n,3).

    The normals are zero for triangles without area.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import triangle_areas_and_normals
    >>> V, F = np.array([[0.0, 0, 0], [2, 0, 0], [0, 2, 0]]), np.array([[0, 1, 2]])
    >>> areas, normals = triangle_areas_and_normals(V, F)
    >>> areas, np.abs(normals)
    (array([2.]), array([[0., 0., 1.]]))
    """
    areas, normals = np.empty(len(F)), np.empty((3, len(F))).T  # as `algebra.columns` wants it
    for block, edges in edge_vectors(V, F):
        vectors = double_area_vectors(edges)
        lengths = np.linalg.norm(vectors, axis=0)
        areas[block] = lengths / 2.0
        normals[block] = (vectors / np.where(lengths > 0.0, lengths, 1.0)).T
    return areas, normals


def areas_and_normals(V, F, of_triangles=None):
    """Return barycentric vertex areas and area-weighted unit vertex normals.

    `V`: (n,3), rest positions. `F`: (m,3) int, triangles. `of_triangles`: optional, what
    `triangle_areas_and_normals` returns for them. Returns `areas`: (n,), a third of the area of the
    triangles around each vertex, in the units of V squared; `normals`: (n,3), unit normals; zero
    where the triangles around a vertex cancel out or have no area, which disables the cubic term
    there.
    """
    face_areas, face_normals = of_triangles or triangle_areas_and_normals(V, F)
    corners = F.T.astype(np.intp, order="C")

    def at_corners(values):
        return np.sum([np.bincount(corner, values, len(V)) for corner in corners], axis=0)

    areas = at_corners(face_areas) / 3.0
    sums = np.stack([at_corners(face_areas * x) for x in face_normals.T], axis=1)
    lengths = np.linalg.norm(sums, axis=1)
    is_defined = lengths > 1e-12 * areas  # otherwise rounding alone would choose the direction
    normals = np.where(is_defined[:, None], sums, 0.0) / np.where(is_defined, lengths, 1.0)[:, None]
    return areas, normals


def cotangents(V, F):
    """Return the cotangents of the corner angles, as ``(m,3)``: column k belongs to corner k.

    They are bounded on needles, slivers and triangles without area.

    A triangle with a cotangent beyond `MAX_COTANGENT` has all three scaled down together, and
    `1 / MAX_COTANGENT` added. Scaling the three by one factor keeps the triangle's Dirichlet energy
    positive semi-definite, which clamping each on its own would not; the summand ties its corners
    together even where it has no area, so that every edge-connected part stays connected in the
    Laplacian.

    `V`: (n,3), positions. `F`: (m,3) int, triangles. Returns `C`: (m,3), cotangents, without unit.

    Pinkall and Polthier, "Computing discrete minimal surfaces and their conjugates", 1993.
    """
    C = np.empty((3, len(F))).T  # as `algebra.columns` wants it
    for block, e in edge_vectors(V, F):
        dot = -np.stack([(e[k - 2] * e[k - 1]).sum(axis=0) for k in range(3)])
        double_area = np.linalg.norm(double_area_vectors(e), axis=0)
        least = np.abs(dot).max(axis=0) / MAX_COTANGENT
        scale = np.maximum(double_area, least)
        dot /= np.where(scale > 0.0, scale, 1.0)
        dot += np.where(double_area <= least, 1.0 / MAX_COTANGENT, 0.0)
        C[block] = dot.T
    return C
