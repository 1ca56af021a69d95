# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface without its details, and their heights above it.

The normals of the triangles are smoothed as those of the vertices are in `details`: with areas M,

    (M + div(k grad)) g = M n,    k = r^2 / 4

Edges survive: in further rounds, the flow between two triangles is divided by 1 + x^2, where the
result g of the round before turns by x times `EDGE` radians over the radius r (Wang and others,
"Rolling guidance normal filter for geometric processing", 2015, with diffusion in place of a sum).
Only where the surface bends outward: the edge of a cushion is one of the whole shape; a fold, an
eye socket or a mouth is a detail.

The base is the surface with these normals, found by a few global steps that rotate each triangle
from its normal to that one. What is left of the surface are the heights of its details.
"""

from dataclasses import dataclass

import numpy as np

from .. import details
from ..algebra import columns, dot
from ..aliases import FloatArray
from ..limbs.turns import smallest_turns
from ..mesh.rest_measures import triangle_areas_and_normals
from ..styles.solved_style import unit
from .corners import Corners
from .face_graph import FaceGraph

EDGE = 0.35
"""radians over the radius; edges that turn by more survive"""
ROUNDS = 4
"""in which edges become sharp again"""
_STEPS = 3  # of the global step, to the base
_LEAST_AREA = 1e-12


@dataclass(frozen=True, eq=False)
class Base:
    """A surface without its details.

    Attributes
    ----------
    graph : FaceGraph
        Of the surface as it is.
    corners : Corners
    normals : (m,3) array
        Unit normals of the triangles without their details, zero for those without area.
    upward : (n,3) array
        The same of the vertices.
    heights : (n,) array
        How far they are above the base, in the unit box.
    """

    graph: FaceGraph
    corners: Corners
    normals: FloatArray
    upward: FloatArray
    heights: FloatArray


def base_of(setup):
    """Return the Base of the rest shape of a Setup."""
    rest = setup.rest
    graph = FaceGraph(rest.V, rest.F)
    corners = Corners(rest.F, rest.cotangents, graph.edges, len(rest.V))
    normals, heights = graph.normals, np.zeros(len(rest.V))
    if rest.options.detail:
        normals = _smooth_normals(graph, rest.detail_radii[rest.F].mean(axis=1))
    weighted = graph.areas[:, None] * normals
    upward = unit(corners.sums(np.repeat(weighted[:, None], 3, axis=1)))
    if rest.options.detail:
        away = rest.V - _integrated(setup, corners, graph.normals, normals)
        heights = dot(*columns(away), *columns(upward))
    return Base(graph, corners, normals, upward, heights)


def _smooth_normals(graph, radius):
    """Return the unit normals (m,3) of triangles without details, for radii (m,)."""
    conductance = graph.length / graph.distance
    conductance *= 0.125 * (radius[graph.one] ** 2 + radius[graph.other] ** 2)
    between = 0.5 * (radius[graph.one] + radius[graph.other])
    found = _diffused(graph, conductance, graph.normals)
    for _ in range(ROUNDS):
        guide = unit(found)
        turn = np.linalg.norm(guide[graph.one] - guide[graph.other], axis=1)
        x = turn * between / graph.distance / EDGE * graph.is_convex(guide)
        found = _diffused(graph, conductance / (1.0 + x * x), found)
    return unit(np.where(graph.areas[:, None] > 0.0, found, 0.0))


def _diffused(graph, conductance, near):
    """Solve (M + div(k grad)) g = M n from a solution near it."""
    areas = graph.areas + _LEAST_AREA
    A = graph.matrix(-conductance, areas + graph.sums(conductance))
    return details.solved(A, areas[:, None] * graph.normals, near)


def _integrated(setup, corners, at_rest, normals):
    """Return vertices (n,3) of the surface in which triangles have other normals (m,3)."""
    rest, B, now = setup.rest, setup.rest.V, at_rest
    skin = rest.skin.matrix(rest.skin.laplacian)
    of_links = rest.matrices.matrix(rest.matrices.laplacian) @ B - skin @ B  # they do not turn
    for _ in range(_STEPS):
        turned = smallest_turns(now, normals) @ corners.pulls(B[rest.F]).swapaxes(1, 2)
        B = setup.global_step.positions(corners.sums(turned.swapaxes(1, 2)) + of_links, B)
        now = triangle_areas_and_normals(B, rest.F)[1]
    return B

