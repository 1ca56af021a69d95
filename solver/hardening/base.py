# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface without its details, and their heights above it.

The base is the surface with the normals of `details`, found by a few global steps that rotate each
triangle from its normal to that one. What is left of the surface are the heights of its details.
"""

from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from ..algebra import by_blocks, columns, dot
from ..aliases import FloatArray
from ..limbs.turns import smallest_turns
from ..mesh.face_graph import FaceGraph
from ..mesh.rest_measures import triangle_areas_and_normals
from ..surface.details import at_vertices, unit
from ..surface.rest import RestMesh
from .corners import Corners, pulls
from .linked_faces import LinkedFaces

TILTED = 0.99
"""cosine between a triangle and the surface without details, below which these tilt it"""

_STEPS = 3  # of the global step, to the base


@dataclass(frozen=True, eq=False)
class Base:
    """A surface without its details."""

    rest: RestMesh
    graph: FaceGraph
    """of the surface as it is"""
    corners: Corners
    normals: FloatArray
    """(m,3) unit normals of the triangles without their details, zero for those without area"""
    upward: FloatArray
    """(n,3) the same of the vertices"""
    heights: FloatArray
    """(n,) how far they are above the base, in the unit box"""
    links: LinkedFaces

    @cached_property
    def is_tilted(self):
        """(m,) bool, the triangles that details tilt."""
        return (self.normals * self.graph.normals).sum(axis=1) < TILTED

    @cached_property
    def thickness(self):
        """(m,) of the shape at the triangles, zero where there is none, and in sides that are flat.

        So a roof of flat sides keeps its ridge, see `planes.py`.
        """
        rest = self.rest
        counts = np.isfinite(rest.thickness) & ~rest.is_flat
        return np.where(counts, rest.thickness, 0.0)[rest.F].mean(axis=1)


def base_of(setup):
    """Return the Base of the rest shape of a Setup."""
    rest = setup.rest
    graph = rest.face_graph
    corners = Corners(rest.F, rest.cotangents, graph.edges, len(rest.V))
    normals, heights = unit(rest.face_normals), np.zeros(len(rest.V))
    upward, _ = at_vertices(normals, graph.areas, rest.F, len(rest.V))
    if rest.options.detail:
        away = rest.V - _integrated(setup, corners, graph.normals, normals)
        heights = dot(*columns(away), *columns(upward))
    return Base(rest, graph, corners, normals, upward, heights, LinkedFaces(rest))


def _integrated(setup, corners, at_rest, normals):
    """Return vertices (n,3) of the surface in which triangles have other normals (m,3)."""
    rest, B, now = setup.rest, setup.rest.V, at_rest
    skin = rest.skin.matrix(rest.skin.laplacian)
    of_links = rest.matrices.matrix(rest.matrices.laplacian) @ B - skin @ B  # they do not turn
    for _ in range(_STEPS):
        turned = partial(_turned_pulls, B)
        sums = corners.sums(by_blocks(turned, now, normals, corners.cotangents, rest.F))
        B = setup.global_step.positions(sums + of_links, B)
        now = triangle_areas_and_normals(B, rest.F)[1]
    return B


def _turned_pulls(B, now, normals, C, F):
    """Return the pulls (k,3,3) of triangles turned from normals (k,3) to others."""
    return (smallest_turns(now, normals) @ pulls(C, B[F]).swapaxes(1, 2)).swapaxes(1, 2)
