# SPDX-License-Identifier: GPL-3.0-or-later
"""Polytopes as the forms of local problems: a step of their active sets, and projections."""

import numpy as np

from .cube import CUBE
from .faces import faces_of

NEAREST_FACET = 0.9
"""cosine of the angle between a normal and that of a facet to which it may go at once"""


def polytopes(forms, body):
    """Return the form of local problems: Polytopes by `body` (n,) int or, without any, the cube."""
    return Polytopes(faces_of(forms), body) if forms else CUBE


class Polytopes:
    """The forms of n local problems; each vertex of the mesh has one of several bodies.

    The state of a vertex is its subgradient and the number of the face that it lies on (4,).

    `faces`: Faces. `body`: (n,) int, number of each vertex's body.
    """

    width = 4
    """columns of a state"""

    def __init__(self, faces, body):
        self.faces = faces
        self._body = body

    def part(self, rows):
        """Return the form of some rows."""
        return Polytopes(self.faces, self._body[rows])

    def cost(self, x):
        """Return the costs (n,) of normals x (n,3) in the frame of the form."""
        return np.einsum("ni,ni->n", x, self.faces.points[self.costliest(x)])

    def starting(self, x):
        """Return the states (n,4) to begin with, for normals x (n,3): those of vertices."""
        vertex = self.costliest(x)
        return np.column_stack([self.faces.points[vertex], vertex])

    def begin(self, states):
        """Return what is kept from step to step: s (n,3) and the face (n,)."""
        return states[:, :3], states[:, 3].astype(np.int32)

    def end(self, kept):
        """Return the states (n,4)."""
        return np.vstack([kept[0].T, kept[1]]).T

    def active_count(self, kept):
        """Return as `Cube.active_count`: two are active on a facet, one on an edge."""
        face = kept[1]
        return (face >= self.faces.edge_start).astype(int) + (face >= self.faces.facet_start)

    def constraints(self, kept):
        """Return as `Cube.constraints`."""
        s, face = kept
        return s, self.active_count(kept), self.faces.axes[face]

    def next_set(self, kept, moment, x, y, problem, slack):
        """Return as `Cube.next_set`."""
        s, face = kept[0].copy(), kept[1].copy()
        is_kept = np.ones(len(face), bool)
        fixed = np.einsum("nji,nj->ni", problem.Q, self.faces.points[face])
        force = moment - problem.lam[:, None] * np.cross(y, fixed)
        kind = self.active_count(kept)
        for number, step in enumerate((_from_vertex, _from_edge, _from_facet)):
            rows = np.flatnonzero((kind == number) & (problem.lam > 0.0))
            if len(rows):
                normals = force[rows], x[rows], y[rows]
                s[rows], face[rows], is_kept[rows] = step(
                    problem.part(rows), s[rows], face[rows], *normals, slack
                )
        return (s, face), is_kept

    def split(self, x, states):
        """Return normals x (n,3), moved to where the face of their state costs most."""
        face = states[:, 3].astype(int)
        axes = self.faces.axes[face]
        along = np.einsum("ni,ni->n", x, axes)[:, None] * axes
        is_facet = (face >= self.faces.facet_start)[:, None]
        return np.where(is_facet, along, x - along)

    def project(self, points):
        """Return the states (n,4) nearest to points (n,3); those inside a body stay."""
        states = np.empty((len(points), 4))
        for rows, polytope, starts in self._bodies():
            states[rows] = _nearest(points[rows], polytope, self.faces, starts)
        return states

    def costliest(self, x):
        """Return the vertex (n,) that costs most at normals x (n,3)."""
        best = np.empty(len(x), np.int32)
        for rows, polytope, starts in self._bodies():
            best[rows] = starts[0] + (x[rows] @ polytope.vertices.T).argmax(axis=1)
        return best

    def _bodies(self):
        """Yield the rows of each body, the Polytope and the numbers of its first faces."""
        starts = np.array([0, self.faces.edge_start, self.faces.facet_start])
        for number, polytope in enumerate(self.faces.bodies):
            rows = np.flatnonzero(self._body == number)
            if len(rows):
                yield rows, polytope, starts
            starts = starts + [len(polytope.vertices), len(polytope.edges), len(polytope.normals)]


def _from_vertex(problem, s, face, force, x, y, slack):
    """Go to what the vertex that costs most shares with this one, or to that vertex."""
    faces = problem.form.faces
    best = problem.form.costliest(x)
    way = faces.points[best] - faces.points[face]
    size = np.linalg.norm(way, axis=1)
    is_kept = np.einsum("ni,ni->n", way, x) <= slack * size
    shared = faces.shared(face, best)
    is_far = (shared >= faces.facet_start) & (
        np.einsum("ni,ni->n", faces.axes[shared], x) < NEAREST_FACET
    )
    face = np.where(is_kept, face, np.where(is_far, best, shared))
    is_vertex = (face < faces.edge_start)[:, None]
    return np.where(is_vertex, faces.points[face], s), face, is_kept


def _from_edge(problem, s, face, force, x, y, slack):
    """Find where on the edge s is; go to a vertex beyond it, or to the facet that x has passed."""
    faces = problem.form.faces
    axis, length = faces.axes[face], faces.lengths[face]
    p = np.cross(y, np.einsum("nji,nj->ni", problem.Q, axis))
    size = np.maximum(np.einsum("ni,ni->n", p, p), 1e-6)
    along = np.einsum("ni,ni->n", force, p) / (problem.lam * size)
    is_kept = (along >= -slack) & (along <= length + slack)
    inside = np.clip(along, 0.0, length)
    s = faces.points[face] + inside[:, None] * axis
    a, b = problem.form.faces.ends_of(face)
    next_face = np.where(along < 0.0, a, np.where(along > length, b, face))
    links = faces.links[face, :1] + [0, 1]
    passed = np.einsum("nki,ni->nk", faces.ways[links], x)
    facet = np.take_along_axis(faces.targets[links], passed.argmax(axis=1)[:, None], axis=1)[:, 0]
    is_passed = (next_face == face) & (passed.max(axis=1) > slack)
    return s, np.where(is_passed, facet, next_face), is_kept & ~is_passed


def _from_facet(problem, s, face, force, x, y, slack):
    """Find where on the facet s is; go to the edge that it has passed, or to one of its ends."""
    faces = problem.form.faces
    axis = faces.axes[face]
    aside = np.einsum("nij,nj->ni", problem.Q, np.cross(force, y)) / problem.lam[:, None]
    s = faces.points[face] + aside - np.einsum("ni,ni->n", aside, axis)[:, None] * axis
    begin, end = faces.links[face].T
    row, link = _pairs(begin, end)
    edge = faces.targets[link]
    inside = np.einsum("ki,ki->k", s[row] - faces.points[edge], faces.ways[link])
    first = np.concatenate([[0], (end - begin).cumsum()[:-1]])
    least = np.minimum.reduceat(inside, first)
    is_worst = inside == least[row]
    worst = np.zeros(len(face), int)
    worst[row[is_worst][::-1]] = edge[is_worst][::-1]
    is_kept, is_inside = least >= -slack, least >= 0.0
    outside_s, outside_face = faces.onto_edge(s, worst)
    return (
        np.where(is_inside[:, None], s, outside_s),
        np.where(is_inside, face, outside_face),
        is_kept,
    )


def _pairs(begin, end):
    """Return for ranges (n,) the number of each range and each entry in it, both (k,)."""
    counts = end - begin
    row = np.repeat(np.arange(len(begin)), counts)
    first = np.repeat(counts.cumsum() - counts, counts)
    return row, np.arange(len(row)) - first + begin[row]


def _nearest(points, polytope, faces, starts):
    first_edge, first_facet = starts[1], starts[2]
    edges = first_edge + np.arange(len(polytope.edges))
    excess = points @ polytope.normals.T - polytope.offsets
    links = faces.links[edges, :1] + [0, 1]
    away = points[:, None] - faces.points[edges]
    inside = np.einsum("nei,eki->nek", away, faces.ways[links])
    is_over = np.ones(excess.shape, bool)  # within the edges of the facet
    facet = faces.targets[links] - first_facet
    for (edge, k), number in np.ndenumerate(facet):
        is_over[:, number] &= inside[:, edge, k] >= 0.0
    is_in = (excess <= 0.0).all(axis=1)
    height = np.where(is_over & (excess > 0.0), excess, -np.inf)
    best = np.where(is_in, excess.argmax(axis=1), height.argmax(axis=1))
    is_on_facet = is_in | np.isfinite(height.max(axis=1))
    lift = np.where(is_in, 0.0, np.maximum(excess[np.arange(len(points)), best], 0.0))
    on_facet = points - lift[:, None] * polytope.normals[best]
    along = np.einsum("nei,ei->ne", away, faces.axes[edges]).clip(0.0, faces.lengths[edges])
    distance = np.linalg.norm(away - along[..., None] * faces.axes[edges], axis=2)
    on_edge, face = faces.onto_edge(points, edges[distance.argmin(axis=1)])
    s = np.where(is_on_facet[:, None], on_facet, on_edge)
    return np.column_stack([s, np.where(is_on_facet, first_facet + best, face)])
