# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces of polytopes as tables: what a subgradient can lie on, and what is next to it.

A subgradient s of the cost at a normal x lies on a face of the body: in a vertex where x is in its
open normal cone, on an edge where two vertices cost the same, on a facet where x is its normal.
The tables of several bodies follow each other, so that the number of a face also says which body
a vertex of the mesh is turned toward: all vertices first, then all edges, then all facets.
"""

from dataclasses import dataclass

import numpy as np

from ..aliases import FloatArray, IntArray
from .polytope import Polytope


@dataclass(frozen=True)
class Faces:
    """The tables of several bodies: a row per face (k), and per link to one next to it (l)."""

    points: FloatArray
    """(k,3) the vertex, the first end of the edge, the foot point of the facet"""
    axes: FloatArray
    """(k,3) zero, unit direction of the edge, normal of the facet"""
    lengths: FloatArray
    """(k,) zero, length of the edge, zero"""
    vertices: IntArray
    """(k,2) int, the vertices of the body: from, and up to but without"""
    links: IntArray
    """(k,2) int, the links of the face: from, and up to but without"""
    targets: IntArray
    """(l,) int, the face that a link leads to: from a vertex and from a facet to edges, from an
    edge to its facets"""
    ways: FloatArray
    """(l,3) unit vectors: along the edge from its vertex; from an edge into the facet, whichever of
    the two the link belongs to"""
    edge_start: int
    """number of the first edge: how many vertices there are"""
    facet_start: int
    """number of the first facet"""
    edge_ends: IntArray
    """(e,2) int, the vertices of each edge"""
    between: IntArray
    """(b,) int, for each vertex and all vertices of its body, the edge or the facet that both
    share; where there is none, the other vertex"""
    between_start: IntArray
    """(v,) int, where in `between` those of a vertex begin"""
    bodies: tuple[Polytope, ...]

    def ends_of(self, edge):
        """Return the two vertices of edges (n,)."""
        return self.edge_ends[edge - self.edge_start].T

    def shared(self, vertex, other):
        """Return the face (n,) that two vertices of one body share, or the other vertex."""
        return self.between[self.between_start[vertex] + other - self.vertices[vertex, 0]]

    def onto_edge(self, points, edge):
        """Return the points (n,3) of edges (n,) nearest to points (n,3), and their faces (n,)."""
        start, axis, length = self.points[edge], self.axes[edge], self.lengths[edge]
        along = np.einsum("ni,ni->n", points - start, axis)
        a, b = self.ends_of(edge)
        face = np.where(along <= 0.0, a, np.where(along >= length, b, edge))
        return start + along.clip(0.0, length)[:, None] * axis, face


def faces_of(bodies):
    """Return the Faces of Polytopes."""
    counts = np.array([[len(x.vertices), len(x.edges), len(x.normals)] for x in bodies])
    starts = np.concatenate([np.zeros((1, 3), int), counts.cumsum(axis=0)])
    totals = starts[-1]
    offsets = starts + [0, totals[0], totals[0] + totals[1]]
    blocks = [_blocks(body, first) for body, first in zip(bodies, offsets, strict=False)]
    rows = [kind for kinds in zip(*blocks, strict=True) for kind in kinds]
    points, axes, lengths, sizes, targets, ways = map(np.concatenate, zip(*rows, strict=True))
    of_bodies = np.stack([starts[:-1, 0], starts[1:, 0]], axis=1)
    ends = sizes.cumsum()
    vertices = np.concatenate([of_bodies.repeat(x, axis=0) for x in counts.T])
    links = np.stack([ends - sizes, ends], axis=1)
    edge_ends = np.concatenate(
        [body.edges + first[0] for body, first in zip(bodies, offsets[:-1], strict=True)]
    )
    between = [_between(body, first) for body, first in zip(bodies, offsets, strict=False)]
    sizes = np.concatenate([np.full(len(shared), len(shared)) for shared in between])
    return Faces(
        *(points, axes, lengths, vertices.astype(np.int32), links.astype(np.int32)),
        *(targets.astype(np.int32), ways),
        int(totals[0]),
        int(totals[0] + totals[1]),
        edge_ends,
        np.concatenate([shared.ravel() for shared in between]).astype(np.int32),
        sizes.cumsum() - sizes,
        tuple(bodies),
    )


def _between(body, first):
    """Return the edge or facet (v,v) that two vertices share, numbered from `first`."""
    shared = body.incidence[:, None] & body.incidence[None]
    result = np.where(
        shared.any(axis=2),
        first[2] + shared.argmax(axis=2),
        first[0] + np.arange(len(body.vertices)),
    )
    a, b = body.edges.T
    result[a, b] = result[b, a] = first[1] + np.arange(len(a))
    return result


def _blocks(body, first):
    """Return the blocks of the vertices, edges and facets of a body, numbered from `first`."""
    ends = body.vertices[body.edges]
    along = ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(along, axis=1)
    along /= lengths[:, None]
    facets = body.edge_facets
    into = np.cross(body.normals[facets], along[:, None, :])
    toward = body.middles[facets] - ends.mean(axis=1)[:, None, :]
    into *= np.sign(np.einsum("eki,eki->ek", into, toward))[:, :, None]
    number = np.arange(len(along))
    to_edges, ways = np.repeat(first[1] + number, 2), np.stack([along, -along], axis=1)
    feet, none = body.offsets[:, None] * body.normals, np.zeros_like(body.vertices)
    return (
        _block(body.vertices, none, none[:, 0], body.edges, to_edges, ways),
        _block(ends[:, 0], along, lengths, np.repeat(number, 2), first[2] + facets.ravel(), into),
        _block(feet, body.normals, np.zeros(len(feet)), facets, to_edges, into),
    )


def _block(points, axes, lengths, owner, targets, ways):
    """Return the rows of some faces, how many links each has, and these, in the order of faces."""
    order = np.argsort(owner, axis=None, kind="stable")
    sizes = np.bincount(owner.ravel(), minlength=len(points))
    return points, axes, lengths, sizes, targets[order], ways.reshape(-1, 3)[order]
