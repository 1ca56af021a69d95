# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces of polytopes as tables: what a subgradient can lie on, and what is next to it.

A subgradient s of the cost at a normal x lies on a face of the body: in a vertex where x is in its
open normal cone, on an edge where two vertices cost the same, on a facet where x is its normal.
The tables of several bodies follow each other, so that the number of a face also says which body
a vertex of the mesh is turned toward: all vertices first, then all edges, then all facets.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..aliases import FloatArray, IntArray
from .polytope import Polytope


class FaceArrays(NamedTuple):
    """One row per face (k of them), and one row per link from a face to one next to it."""

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


@dataclass(frozen=True)
class Faces:
    """The tables of several bodies.

    `bodies`: sequence of Polytope.
    """

    arrays: FaceArrays
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
        return self.between[self.between_start[vertex] + other - self.arrays.vertices[vertex, 0]]

    def onto_edge(self, points, edge):
        """Return the points (n,3) of edges (n,) nearest to points (n,3), and their faces (n,)."""
        start, axis, length = (values[edge] for values in self.arrays[:3])
        along = np.einsum("ni,ni->n", points - start, axis)
        a, b = self.ends_of(edge)
        face = np.where(along <= 0.0, a, np.where(along >= length, b, edge))
        return start + along.clip(0.0, length)[:, None] * axis, face


def faces_of(bodies):
    """Return the Faces of Polytopes."""
    parts = [_Part(body) for body in bodies]
    counts = np.array([part.counts for part in parts]).reshape(-1, 3)
    starts = np.concatenate([np.zeros((1, 3), int), counts.cumsum(axis=0)])
    totals = starts[-1]
    offsets = starts + [0, totals[0], totals[0] + totals[1]]
    rows, links = ([], [], []), ([], [], [])
    for part, first, after in zip(parts, offsets[:-1], offsets[1:], strict=True):
        part.add(rows, links, first, (first[0], after[0]))
    flat = [face for kind in rows for face in kind]
    lists = [found for kind in links for found in kind]
    sizes = np.array([len(found) for found in lists])
    ends = sizes.cumsum()
    joined = [link for found in lists for link in found]
    arrays = FaceArrays(
        points=np.array([face[0] for face in flat]),
        axes=np.array([face[1] for face in flat]),
        lengths=np.array([face[2] for face in flat]),
        vertices=np.array([face[3] for face in flat], np.int32),
        links=np.stack([ends - sizes, ends], axis=1).astype(np.int32),
        targets=np.array([target for target, _ in joined], np.int32),
        ways=np.array([way for _, way in joined]),
    )
    edge_ends = np.concatenate(
        [body.edges + first[0] for body, first in zip(bodies, offsets[:-1], strict=True)]
    )
    between = [_between(body, first) for body, first in zip(bodies, offsets, strict=False)]
    sizes = np.concatenate([np.full(len(shared), len(shared)) for shared in between])
    return Faces(
        arrays,
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


class _Part:
    """The faces of one body."""

    def __init__(self, body):
        self._body = body
        self.counts = len(body.vertices), len(body.edges), len(body.normals)
        ends = body.vertices[body.edges]
        along = ends[:, 1] - ends[:, 0]
        self._lengths = np.linalg.norm(along, axis=1)
        self._along = along / self._lengths[:, None]
        self._facets = body.edge_facets
        into = np.cross(body.normals[self._facets], self._along[:, None, :])
        middle = ends.mean(axis=1)
        toward = body.middles[self._facets] - middle[:, None, :]
        sign = np.sign(np.einsum("eki,eki->ek", into, toward))
        self._into = into * sign[:, :, None]

    def add(self, rows, links, first, vertices):
        """Append to rows and links of vertices, edges and facets, numbered from `first`."""
        body, nothing = self._body, np.zeros(3)
        at_vertex = [[] for _ in body.vertices]
        at_facet = [[] for _ in body.normals]
        for e, (a, b) in enumerate(body.edges):
            number = first[1] + e
            at_vertex[a].append((number, self._along[e]))
            at_vertex[b].append((number, -self._along[e]))
            rows[1].append((body.vertices[a], self._along[e], self._lengths[e], vertices))
            found = []
            for facet, way in zip(self._facets[e], self._into[e], strict=True):
                at_facet[facet].append((number, way))
                found.append((first[2] + facet, way))
            links[1].append(found)
        for point, found in zip(body.vertices, at_vertex, strict=True):
            rows[0].append((point, nothing, 0.0, vertices))
            links[0].append(found)
        for normal, offset, found in zip(body.normals, body.offsets, at_facet, strict=True):
            rows[2].append((offset * normal, normal, 0.0, vertices))
            links[2].append(found)
