# SPDX-License-Identifier: GPL-3.0-or-later
"""The local step of hardening: a rotation for each triangle, which puts it on its side.

A triangle f of a side has one rotation R_f, which takes its normal without details c_f to that of
the side t_f; only its turn about that is free. It is fitted to a triangle that lies flat but for
its details: with its edges across c_f, and the heights h of its corners along it. In the units of
`spokes_and_rims`, where each triangle counts three times,

    E = 3 sum_f [ (1 - b) sum_e w_fe/2 |R_f d_e - d~_e|^2 + b/2 (U t_f - h)' L_f (U t_f - h) ]
        + links + 3/2 sum_i s_i (u_i - v_i)' K_i (u_i - v_i)

The second term, with the larger weight b = `FLATNESS`, asks for the heights alone: a side may
stretch as it becomes flat. Its stiffness L_f is that of the first, so the matrix of the global step
is L as before, but for the third term, which holds the shape near the soft one v and keeps its
volume. K_i is the identity, but for brims, whose flats would hold their outline: they slide along
themselves, and K_i is the mean of t_f t_f' around a vertex. Links pull at the rotations of the
triangles around their vertices, in equal shares. A triangle without a side keeps its shape in the
soft one as rigidly as it can.

With R_f = R0 turned about t_f by an angle, tr(R_f S_f) is x cos + y sin + const, where x and y are
linear in the positions: the best angle has the cosine x / |(x, y)| and the sine y / |(x, y)|. So
the energy falls in both steps (Sorkine and Alexa, "As-Rigid-As-Possible Surface Modeling", 2007).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from ..algebra import blocks, by_blocks, columns, dot
from ..aliases import BoolArray, FloatArray
from ..global_step.motion import Motion
from ..limbs.turns import smallest_turns
from ..mesh.edge_vectors import area_vectors
from ..rotation_fit import fit_rotations, svd_rotations
from ..surface.details import at_vertices
from .base import Base

FLATNESS = 0.9
"""b"""
OF_PLATES = 0.99
"""b of flats that slide along themselves: those of a brim stretch with its outline"""
GAIN = 1.0
"""how much farther out sides are held, relative to how far they have sunk"""


@dataclass(frozen=True, eq=False)
class Target:
    """What the triangles become."""

    base: Base
    heights: FloatArray
    """(n,) of the details that the result has, in the unit box"""
    directions: FloatArray
    """(m,3) t_f, zero for triangles without a side"""
    is_free: BoolArray
    """(m,) bool these"""
    soft: FloatArray
    """(n,3) v, in the unit box"""
    hold: FloatArray
    """(n,) s_i, with the areas of the vertices"""
    slides: FloatArray
    """(n,) how far vertices slide along their sides, from 0 to 1"""


class FaceStep:
    """Rotations of triangles from positions, and the right-hand side of the global step.

    It has the interface of `NumpyLocalStep`.

    Attributes
    ----------
    outward : (n,) array
        How much farther out sides are held than in the soft shape.
    """

    device = "numpy"
    compile_seconds = 0.0
    resolution = 1e-9

    def __init__(self, rest, target):
        self._rest, self._target = rest, target
        self._corners = target.base.corners
        self._held = target.soft
        self.outward = np.zeros(len(rest.V))
        self._free = np.flatnonzero(target.is_free)
        flatness = FLATNESS + target.slides[rest.F].min(axis=1) * (OF_PLATES - FLATNESS)
        self._flatness = np.where(target.is_free, 0.0, flatness)
        traces = self._begin_turning(self._flat_edges())
        skin, whole = (m.matrix(m.laplacian) for m in (rest.skin, rest.matrices))
        self._whole = whole
        self._rest_terms = 1.5 * self._sums_over_faces(traces) + 1.5 * rest.topology.sum_parts(
            (rest.V * ((whole - skin) @ rest.V)).sum(axis=1)
        )
        self._begin_flatness()
        self._begin_sliding()

    def _flat_edges(self):
        """Return the corners (m,3,3) that triangles have at rest: flat but for their details."""
        target, V, F = self._target, self._rest.V, self._rest.F

        def flat(F, normals):
            corners, up = V[F], normals[:, None]
            heights = target.heights[F] - np.einsum("mkj,mlj->mk", corners, up)
            return corners + heights[..., None] * up

        corners = by_blocks(flat, F, target.base.normals)
        corners[self._free] = target.soft[F[self._free]]
        return corners

    def _begin_turning(self, edges):
        """Take what the angles do: tr(R_f S_f) = x cos + y sin + const; return tr S_f (m,).

        ``_angles`` (2m,3n) takes positions to x and y, and its transpose a cosine and a sine to
        pulls at the vertices. What the fixed part of R_f pulls with is ``_steady`` (n,3).
        """
        rest, F = self._rest, self._rest.F
        m, n = len(F), len(rest.V)
        share, pulls = 1.0 - self._flatness, self._corners.pulls(edges)
        traces = share * np.einsum("mkj,mkj->m", edges, pulls)
        pulls *= (3.0 * share)[:, None, None]
        self._turn, self._of_vertices = np.repeat([[1.0], [0.0]], m, axis=1), None
        self._free_R = np.repeat(np.eye(3)[None], len(self._free), axis=0)
        sided = np.flatnonzero(~self._target.is_free)
        steady, entries = np.zeros_like(pulls), np.empty((2, len(sided), 3, 3))
        for block in blocks(len(sided)):
            some = pulls[sided[block]]
            along, *turning = self._parts(sided[block])
            steady[sided[block]] = some @ along.swapaxes(1, 2)
            for into, part in zip(entries, turning, strict=True):
                np.matmul(some, part.swapaxes(1, 2), out=into[block])
        self._steady = self._corners.sums(steady)
        columns = np.empty(entries.shape, np.int32)
        columns[:] = 3 * F[sided, :, None] + np.arange(3, dtype=np.int32)
        ends = np.append(0, np.cumsum(np.tile(~self._target.is_free, 2), dtype=np.int32) * 9)
        self._angles = sp.csr_matrix((entries.ravel(), columns.ravel(), ends), shape=(2 * m, 3 * n))
        at, count = np.repeat(F[self._free], 3, axis=0).ravel(), 3 * len(self._free)
        free = pulls[self._free].swapaxes(1, 2).ravel(), at, np.arange(0, 3 * count + 1, 3)
        self._free_pulls = sp.csr_matrix(free, shape=(count, n))
        self._free_pulls.sum_duplicates()
        self._add_links()
        return traces

    def _parts(self, faces):
        """Return the three (k,3,3) that the R_f of some triangles are sums of.

        As it is; times the cosine; times the sine. They are found anew, as they are rarely used and
        take more memory than anything else.
        """
        target = self._target
        t, c = target.directions[faces], target.base.normals[faces]
        along = t[:, :, None] * c[:, None, :]
        across = smallest_turns(c, t) - along
        parts = along, across, np.cross(t[:, :, None], across, axisa=1, axisb=1, axisc=1)
        for part in parts:
            part[target.is_free[faces]] = 0.0  # these are fitted one by one
        return parts

    def _add_links(self):
        links = self._target.base.links
        self._is_free = self._target.is_free[links.faces]
        self._of_free = np.searchsorted(self._free, links.faces[self._is_free])
        along, *self._linked_parts = self._parts(links.faces)
        self._steady += links.pulls(along)

    @property
    def of_faces(self):
        """(m,3,3) rotations R_f of the triangles."""
        R = np.empty((len(self._flatness), 3, 3))
        for rows in blocks(len(R)):
            along, across, turned = self._parts(rows)
            cosine, sine = self._turn[:, rows, None, None]
            R[rows] = along + cosine * across + sine * turned
        R[self._free] = self._free_R
        return R

    @property
    def R(self):  # noqa: N802 - as in `NumpyLocalStep`
        """(n,3,3) rotations of the vertices: between those of the triangles around them."""
        if self._of_vertices is None:
            self._of_vertices = self._found_at_vertices()
        return self._of_vertices

    def _found_at_vertices(self):
        R, corners = self.of_faces, self._corners
        near, sums = R[corners.last_around()], corners.sums_around(R.reshape(-1, 9))

        def fitted(sums, near):
            return fit_rotations(sums.reshape(-1, 3, 3).swapaxes(1, 2).copy(), near)

        return by_blocks(fitted, sums, near)

    def start_from(self, R):
        """Begin with rotations (n,3,3) of the vertices; only triangles without a side remember."""
        means = R[self._rest.F[self._free]].sum(axis=1)
        self._free_R, self._of_vertices = by_blocks(svd_rotations, means.swapaxes(1, 2)), None

    def go_on_with(self, rest, target):
        """Return one with another Target, from the same rotations and held as far out."""
        other = FaceStep(rest, target)
        other._free_R = self.of_faces[other._free]
        other.hold_outward(self.outward)
        return other

    def motion(self, setup, U, constraints=()):
        """Return the Motion that follows these rotations, from positions U (n,3)."""
        self.update(U)
        return Motion(setup, self, U, constraints)

    def update(self, U):
        """Fit all rotations to the positions U (n,3); return energies as `NumpyLocalStep`."""
        xy = (self._angles @ U.ravel()).reshape(2, -1)
        links = self._target.base.links
        linked = links.covariances(U)
        xy[:, links.faces] += [np.einsum("kij,kji->k", R, linked) for R in self._linked_parts]
        gains = np.hypot(*xy)
        is_clear = gains > 0.0
        self._turn = np.where(is_clear, xy, [[1.0], [0.0]]) / np.where(is_clear, gains, 1.0)
        self._of_vertices = None
        turned = self._steady + (self._angles.T @ self._turn.ravel()).reshape(-1, 3)
        if len(self._free):
            S = (self._free_pulls @ U).reshape(-1, 3, 3)
            S[self._of_free] += linked[self._is_free]
            self._free_R = by_blocks(fit_rotations, S, self._free_R)
            gains[self._free] = np.einsum("mij,mji->m", self._free_R, S)
            turned += self._free_pulls.T @ self._free_R.swapaxes(1, 2).reshape(-1, 3)
        cosine, sine = self._turn[:, links.faces, None, None]
        across, aside = self._linked_parts
        R = cosine * across + sine * aside
        R[self._is_free] = self._free_R[self._of_free]
        turned += links.pulls(R)
        back = self._held_back(U)
        self._rhs = self._right_hand_side(U, turned, back)
        return self._energies(U, gains, back), np.zeros(self._rest.topology.component_count)

    def right_hand_side(self):
        """Return the right-hand side (n,3) of the global step for the present rotations."""
        return self._rhs

    def give_back_volume(self, U):
        """Hold the sides farther out by as much as they have sunk at positions U (n,3), on average.

        What is cut off a rounded side is not all put on at its edges, which resist.
        """
        rest, soft = self._rest, self._soft_areas
        hard, moved = area_vectors(U, rest.F), U - self._target.soft

        def lost_by(F, soft, hard):
            moves = moved[F[:, 0]] + moved[F[:, 1]] + moved[F[:, 2]]
            return -0.25 * dot(*columns(soft + hard), *columns(moves / 3.0))

        lost = self._sums_over_faces(by_blocks(lost_by, rest.F, soft, hard))
        area = self._sums_over_faces(0.5 * np.sqrt(dot(*columns(soft), *columns(soft))))
        outward = GAIN * lost / np.where(area > 0.0, area, 1.0)
        self.hold_outward(outward[rest.topology.component])

    @cached_property
    def _soft_areas(self):
        """(m,3) normals of the triangles of the soft shape, as long as twice the area."""
        return area_vectors(self._target.soft, self._rest.F)

    def hold_outward(self, outward):
        """Hold the sides farther out by so much at the vertices (n,)."""
        self._held = self._held + outward[:, None] * self._out
        self.outward = self.outward + outward

    @cached_property
    def _out(self):
        """(n,3) unit vectors at the vertices that the sides around them face, or zero."""
        F, target = self._rest.F, self._target
        return at_vertices(target.directions, target.base.graph.areas, F, len(self.outward))[0]

    def hold_beside(self, moves):
        """Hold the shape near a soft one whose vertices have moved so far (n,3)."""
        self._held = self._held + moves

    def _begin_flatness(self):
        """Take sum_f b (1 - t_f t_f') L_f, six of its parts, and the pull of heights."""
        target, F = self._target, self._rest.F
        t, weight = target.directions, self._flatness
        parts = {
            (p, q): self._corners.stiffness(weight * ((p == q) - t[:, p] * t[:, q]))
            for p in range(3)
            for q in range(p, 3)
        }
        self._along = [[parts[min(p, q), max(p, q)] for q in range(3)] for p in range(3)]
        heights = target.heights[F]
        pulls = weight[:, None] * self._corners.pulls(heights)
        self._lift = self._corners.sums(pulls[:, :, None] * t[:, None, :])
        self._rest_terms = self._rest_terms + 1.5 * self._sums_over_faces(
            (heights * pulls).sum(axis=1)
        )

    def _begin_sliding(self):
        """Take what is left free of each vertex, I - K (n,3,3), or None, if nothing slides."""
        target, self._free_ways = self._target, None
        if not target.slides.any():
            return
        t, areas = target.directions, target.base.graph.areas[:, None, None]
        along = np.where(target.is_free[:, None, None], 0.0, np.eye(3) - t[:, :, None] * t[:, None])
        weight = self._corners.sums_around(areas[:, 0])[:, :, None]
        sums = self._corners.sums_around((areas * along).reshape(-1, 9))
        means = sums.reshape(-1, 3, 3) / np.where(weight > 0.0, weight, 1.0)
        self._free_ways = target.slides[:, None, None] * means

    def _held_back(self, U):
        """Return s K (u - v) (n,3) at positions U (n,3)."""
        moved = U - self._held
        if self._free_ways is not None:
            moved = moved - np.einsum("nij,nj->ni", self._free_ways, moved)
        return self._target.hold[:, None] * moved

    def _right_hand_side(self, U, turned, back):
        x, target = U.T.copy(), self._target
        along = [sum(K @ x[q] for q, K in enumerate(row)) for row in self._along]
        self._flat = np.stack(along, axis=1) + self._lift
        return turned / 3.0 + self._flat + (target.hold[:, None] * U - back)

    def _energies(self, U, gains, back):
        sum_parts = self._rest.topology.sum_parts
        of_vertices = (U * (self._whole @ U - self._flat - self._lift)).sum(axis=1)
        of_vertices += ((U - self._held) * back).sum(axis=1)
        of_faces = self._sums_over_faces(gains) + sum_parts((U * self._steady).sum(axis=1))
        return self._rest_terms - of_faces + 1.5 * sum_parts(of_vertices)

    def _sums_over_faces(self, values):
        topology = self._rest.topology
        return np.bincount(topology.component[self._rest.F[:, 0]], values, topology.component_count)
