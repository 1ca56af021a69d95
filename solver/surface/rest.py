# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of a mesh, regardless of cubeness, orientation and pins."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..aliases import BoolArray, FloatArray, IntArray
from ..coarse_to_fine.contraction import contract
from ..contacts.crossings import CrossingTriangles
from ..contacts.polygons import are_apart
from ..inputs import real_numbers
from ..limbs import (
    Limbs,
    along_boxes,
    limbs_of_shape,
    with_coverings,
    with_hollows,
    with_plates,
    without_shells,
)
from ..limbs.covering import COVERING
from ..mesh.edges import Triangles
from ..mesh.face_graph import FaceGraph
from ..mesh.rest_measures import areas_and_normals, triangle_areas_and_normals
from ..mesh.spokes_and_rims import SpokesAndRims, spokes_and_rims
from ..mesh.topology import Topology
from ..mesh.unit_box import UnitBox
from ..proxy import PAPER, InputMap, Links, ProxyOptions, no_links
from ..proxy.boxes import box_frames
from ..proxy.flat_sides import flat_shares
from ..proxy.nearest import Nearest
from ..proxy.samples import extents
from ..proxy.sheets import cards, extrusions, planar_sheets
from ..proxy.thickness import outward_sign
from ..values import Value
from . import details

LIGHT = 0.01
"""weight of planar sheets in place and rotation of what they hang on, in stiffness and links"""
_OF_THE_SURFACE = ("face_graph", "face_normals", "outward", "shown", "thickness", "unrefined_graph")
"""cached properties that links change nothing in"""


@dataclass(frozen=True, eq=False, repr=False)
class RestMesh(Value):
    """The rest shape in the unit box: the proxy of the input, without its loose vertices.

    `rest_mesh` builds it. The arrays are indexed by the `n` vertices that are solved; `input_map`
    maps between them and the `N` vertices of the input.

    Examples
    --------
    >>> from solver import PAPER, rest_mesh
    >>> rest = rest_mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0], [9, 9, 9]], [[0, 1, 2]], PAPER)
    >>> rest.V.shape, rest.input_positions.shape  # the last vertex is loose
    ((3, 3), (4, 3))
    """

    input_positions: FloatArray
    """(N,3) float64 rest positions as given, loose vertices included"""
    input_map: InputMap
    box: UnitBox
    V: FloatArray
    """(n,3) float64 rest positions in the unit box"""
    topology: Topology
    areas: FloatArray
    """(n,) barycentric areas a_i"""
    normals: FloatArray
    """(n,3) unit normals n_i, zero where undefined"""
    is_flat: BoolArray
    """(n,) bool, the vertices of flat sides, which have no detail"""
    smoothness: FloatArray
    """(n,) how meaningful the normals are, from 0 in creases to 1"""
    normal_shares: FloatArray
    """(n,) area that each normal stands for, relative to its own: 0 in creases, more beside them"""
    to_neighbors: Links
    to_other_side: Links | None
    """for a solidity of 1; None if they have not been computed"""
    across_cavities: Links | None
    """likewise"""
    across_gaps: Links | None
    """likewise"""
    options: ProxyOptions
    cotangents: FloatArray
    """(m,3) weight of the edge opposite each corner of the triangles"""
    skin: SpokesAndRims
    """of the triangles only"""
    matrices: SpokesAndRims
    """including the links"""
    triangles: NDArray[np.int32] | None = None
    """(k,3) int32 triangles of the input, as given"""
    unrefined: IntArray | None = None
    """(l,3) int triangles before refinement; None if nothing was refined"""
    pieces: IntArray | None = None
    """(m,) int that of these which each triangle is a piece of, or None"""
    faces: IntArray | None = None
    """(l,) int the face of the input that each of these is a piece of; None if they are whole"""
    given_faces: IntArray | None = None
    """(k,) int the face of the input that each of `triangles` is a piece of, or None"""
    is_cage: bool = False
    """whether these are the faces of a coarser mesh, which is to follow"""
    unposed: RestMesh | None = None
    """the mesh that this is a pose of"""

    @property
    def F(self) -> IntArray:  # noqa: N802 - as everywhere
        """(m,3) int32 triangles."""
        return self.topology.F

    @cached_property
    def used(self) -> IntArray:
        """(n,) int vertex of the input that represents each solved vertex."""
        return self.input_map.source

    @cached_property
    def place(self) -> tuple[IntArray, IntArray]:
        """Vertices of the input that are solved, and the solved vertex of each of them."""
        return self.input_map.place()

    @cached_property
    def box_frames(self) -> tuple[FloatArray | None, BoolArray]:
        """(n,3,3) frames of boxes or None, and (n,) which are wholly so, see `proxy/boxes.py`."""
        if not self.options.refine:
            return None, np.zeros(len(self.V), dtype=bool)
        return box_frames(self.V, self.F, self.topology.part)

    @cached_property
    def outward(self) -> FloatArray:
        """(n,1) -1 for the normals of parts that are inside out, else 1.

        The cube does not care; a pyramid would come out upside down.
        """
        sign = outward_sign(Triangles(self.V, self.F), self.topology.part)
        return np.where(sign < 0.0, -1.0, 1.0)[self.topology.part][:, None]

    @cached_property
    def is_sheet(self) -> BoolArray:
        """(n,) bool, the vertices of planar sheets among other parts, see `proxy/sheets.py`."""
        if not self.options.refine:
            return np.zeros(len(self.V), dtype=bool)
        if self.unposed is not None:  # a flag that begins to wave stays one
            return self.unposed.is_sheet
        return planar_sheets(self.V, self.F, self.topology.part)[self.topology.part]

    @cached_property
    def is_card(self) -> BoolArray:
        """(n,) bool, the vertices of small open sheets, see `proxy/sheets.py`."""
        parts, component = self.topology.part, self.topology.component
        return cards(self.V, self.F, parts, component)[parts]

    @property
    def cubic_normals(self) -> FloatArray:
        """(n,3) unit normals that the cubic term sees, without their details; zero for none."""
        return self._drawn[0]

    @property
    def cubic_shares(self) -> FloatArray:
        """(n,) factors of the cubeness: 0 in creases and sheets, more than 1 beside creases."""
        return np.where(self.is_sheet, 0.0, self._drawn[1])

    @cached_property
    def weighing(self) -> FloatArray:
        """(n,) weights of the vertices in the place of a component: areas, of sheets next to none.

        The crown of a tree sinks into itself; its trunk stays on its roots.
        """
        return np.where(self.is_sheet, LIGHT, 1.0) * self.areas + 1e-300

    @cached_property
    def standing(self) -> FloatArray:
        """(n,) weights of the vertices in the rotation of a component.

        In the paper's energy, they are the areas. Otherwise they are the fourth roots of the areas,
        nearly a count of vertices: a rotation is noticeable where an artist has put many vertices,
        as in a face, but the tiny triangles of a zip must not turn a coat. Leaves, which are planar
        sheets, must not turn a trunk.
        """
        if not self.options.refine:
            return self.areas + 1e-300
        return np.where(self.is_sheet, LIGHT, 1.0) * np.sqrt(np.sqrt(self.areas)) + 1e-300

    @property
    def links(self) -> Links:
        """All links, with their weights."""
        of_walls = no_links()
        for links in (self.to_other_side, self.across_cavities, self.across_gaps):
            of_walls = of_walls if links is None else of_walls.joined(links)
        return self.to_neighbors.joined(of_walls.scaled(self.options.solidity))

    def with_options(self, options: ProxyOptions) -> RestMesh | None:
        """Return the RestMesh with other options, or None if its surface would be another one."""
        now = self.options
        if (options.together, options.refine) != (now.together, now.refine):
            return None
        if options == now:
            return self
        changed = replace(self, options=options)
        if self.to_other_side is None and options.needs_thickness:
            from .preparation import links_within

            triangles, part = Triangles(self.V, self.F), self.topology.part
            found = links_within(triangles, self.normals, self.areas, part)
            names = ("to_other_side", "across_cavities", "across_gaps")
            changed = replace(changed, **dict(zip(names, found, strict=True)))
        if options.solidity != now.solidity:
            matrices = changed.skin.with_links(self.V, changed.links)
            changed = replace(changed, matrices=matrices)
        return changed

    @cached_property
    def thickness(self) -> FloatArray:
        """(n,) of the surface, at the nearest vertex that is linked to its other side."""
        links, n = self.to_other_side, len(self.V)
        if links is None or not len(links):
            return np.full(n, np.inf)
        i, j = links.vertices[:, 0], links.vertices[:, 1]
        part = 10.0 * self.topology.part[:, None]  # farther apart than any part is wide
        place = np.hstack([self.V, part])
        nearest = Nearest(place[i])(place, distance_upper_bound=5.0)
        found = np.append(np.linalg.norm(self.V[j] - self.V[i], axis=1), np.inf)
        return found[nearest]

    @cached_property
    def face_graph(self) -> FaceGraph:
        """The FaceGraph of the surface."""
        return FaceGraph(self.V, self.F)

    @cached_property
    def unrefined_graph(self) -> FaceGraph:
        """The FaceGraph of the triangles before refinement."""
        return self.face_graph if self.unrefined is None else FaceGraph(self.V, self.unrefined)

    @cached_property
    def face_normals(self) -> FloatArray:
        """(m,3) normals of the triangles, without their details; shorter where they disagree."""
        graph = self.face_graph
        if not self.options.detail:
            return graph.normals
        crease = np.where(self.is_flat, self.smoothness, 1.0)
        lower, upper = (ends[graph.edge] for ends in (graph.edges.lower, graph.edges.upper))
        part, component = self.topology.part, self.topology.component
        sizes = extents(self.V, component)[component], self.thickness, extents(self.V, part)[part]
        is_alone = np.bincount(part)[part] == np.bincount(component)[component]
        radius = details.radii(self.options.detail, *sizes, is_alone)[self.F].mean(axis=1)
        if self.options.refine:
            radius *= 1.0 - flat_shares(graph, part[self.F[:, 0]])
        coupling = np.maximum(crease[lower], crease[upper])
        outward, largest = self.outward[self.F[:, 0], 0], np.bincount(part).max()
        return details.smoothed(graph, radius, coupling, outward, largest_part=largest)

    @cached_property
    def _drawn(self) -> tuple[FloatArray, FloatArray]:
        if not self.options.detail:
            return self.normals, self.normal_shares
        F, n = self.F, len(self.V)
        areas, _ = triangle_areas_and_normals(self.V, F)
        normals, length = details.at_vertices(self.face_normals, areas, F, n)
        # without their details, creases have normals, too, but for those between flat sides
        weight = np.where(self.is_flat, self.normal_shares, details.WEIGHT)
        return normals, weight * length * length

    @cached_property
    def limbs(self) -> Limbs:
        """The Limbs of the shape, see `limbs/of_shape.py`. Boxes and letters have none.

        They are the same in all poses, so that no frame of an animation jumps.
        """
        if self.unposed is not None:
            return self.unposed.limbs.posed(self.unposed.V, self.V)
        links = self.to_other_side if self.to_other_side is not None else no_links()
        has_none = extrusions(self.V, self.F, self.topology.part)[self.topology.part]
        has_none |= self.box_frames[1]
        links = links.part(~has_none[links.vertices[:, 0]])
        surface = self.topology.part, self.normals, self.areas
        found = limbs_of_shape(self.V, self.skin, links, *surface)
        found = without_shells(found, self.V, self.topology.part, self.areas, self.thickness)
        cavities = self.across_cavities
        if cavities is not None:
            cavities = cavities.part(~has_none[cavities.vertices[:, 0]])
            found = with_hollows(found, self.V, self.skin, links, cavities, *surface)
        thickness = np.where(self.box_frames[1], np.inf, self.thickness)
        of_surface = self.F, self.face_graph, self.skin, self.topology.part
        found = with_plates(found, self.V, *of_surface, thickness)
        of_faces = self.F, self.face_graph.areas, self.face_graph.normals
        found = along_boxes(found, self.box_frames[0], *of_faces)
        neighbors = self.to_neighbors
        if not len(neighbors):
            return found
        return with_coverings(found, self.V, self.topology.part, neighbors, self.linked_share)

    @cached_property
    def linked_share(self) -> FloatArray:
        """(p,) share of the area of each part that is linked to other parts."""
        links, part = self.to_neighbors, self.topology.part
        # those of a coarser mesh include links within parts
        is_between = part[links.vertices[:, 0]] != part[links.vertices[:, 1]]
        is_end = is_between[:, None] & (links.coefficients != 0.0)
        is_linked = np.zeros(len(self.V), dtype=bool)
        is_linked[links.vertices[is_end]] = True
        area = np.bincount(part, self.areas)
        return np.bincount(part, self.areas * is_linked) / np.where(area > 0.0, area, 1.0)

    @property
    def is_worn(self) -> BoolArray:
        """(p,) bool, parts that are linked to others in so much of their area that these lead."""
        return self.linked_share >= COVERING

    @cached_property
    def shown(self) -> NDArray[np.int32]:
        """(k,3) int triangles of the input between solved vertices: what is seen of the result."""
        assert self.triangles is not None
        number = np.zeros(len(self.input_positions), dtype=np.int32)
        used, place = self.place
        number[used] = place
        return number[self.triangles]

    def along_edges(self, values: FloatArray) -> FloatArray:
        """Return values (n,d) with those of midpoints between those of the ends of their edges."""
        if self.unrefined is None:
            return values
        own = np.zeros((len(self.input_positions), values.shape[1]))
        used, place = self.place
        own[used] = values[place]
        return self.input_map.points(own)

    @property
    def whole(self) -> IntArray | None:
        """(m,) int the triangle before refinement, or the face, that each is a piece of."""
        if self.pieces is None or self.faces is None:
            return self.faces if self.pieces is None else self.pieces
        return self.faces[self.pieces]

    @cached_property
    def crosses_at_rest(self) -> CrossingTriangles:
        """Which triangles of the input cross others at rest."""
        return CrossingTriangles(self.V, self.shown)

    @cached_property
    def polygons_apart(self) -> Callable[[IntArray], BoolArray] | None:
        """Which pairs of the triangles of the input are of polygons apart, as of `are_apart`."""
        return are_apart(self.given_faces, self.shown)

    def with_links(self, links: Links) -> RestMesh:
        """Return the mesh with further links to neighbors."""
        to_neighbors = self.to_neighbors.joined(links)
        return replace(
            self,
            topology=self.topology.linked(to_neighbors.pairs()),
            to_neighbors=to_neighbors,
            matrices=self.matrices.with_links(self.V, links),
        )

    def held_apart(self, links: Links) -> RestMesh:
        """Return the mesh `with_links` that change neither its surface nor what covers what."""
        linked = self.with_links(links)
        known = {name: self.__dict__[name] for name in _OF_THE_SURFACE if name in self.__dict__}
        linked.__dict__.update(known, linked_share=self.linked_share)
        return linked

    def posed(self, input_positions: ArrayLike) -> RestMesh:
        """Return the same mesh in another pose (N,3), with all weights and links of this one.

        Its Laplacian is the same, so what has been factorized can be reused.
        """
        positions = real_numbers(input_positions, "positions").copy()
        V = self.input_map.points(self.box.to_unit(positions))
        areas, normals = areas_and_normals(V, self.F)
        skin = spokes_and_rims(V, self.F, self.cotangents)
        posed = replace(
            self,
            input_positions=positions,
            V=V,
            areas=areas,
            normals=normals,
            skin=skin,
            unposed=self,
        )
        return replace(posed, matrices=skin.with_links(V, posed.links))

    @cached_property
    def edge_sums(self) -> FloatArray:
        """sum_ij w_ij |v_j - v_i|^2 over the ordered pairs of each component."""
        matrices = self.matrices
        rows = np.repeat(np.arange(len(self.V), dtype=np.int32), np.diff(matrices.indptr))
        is_upper = matrices.indices > rows  # each pair is counted once, then twice
        i, j = rows[is_upper], matrices.indices[is_upper]
        squares = np.zeros(len(i))
        for x in self.V.T.copy():
            difference = x.take(j) - x.take(i)
            squares += difference * difference
        weighted = -2.0 * matrices.laplacian[is_upper] * squares
        component, count = self.topology.component, self.topology.component_count
        return np.asarray(np.bincount(component[i], weighted, count), dtype=np.float64)

    @cached_property
    def energy_terms(self) -> FloatArray:
        """(n,) 0.75 sum w |d|^2 - tr S of each vertex at rest, where the ARAP energy is 0."""
        m, V = self.matrices, self.V
        L = m.matrix(m.laplacian)
        quadratic = 2.0 * (V * (L @ V)).sum(axis=1) - L @ (V * V).sum(axis=1)
        trace = sum(m.matrix(m.gather[:, c]) @ V[:, c] for c in range(3))
        return 0.75 * quadratic - trace

    @cached_property
    def coarse(self) -> Coarsening | None:
        """The Coarsening, or None if it is not available."""
        neighbors = self.skin.matrix(self.skin.laplacian)
        contracted = contract(self.V, self.F, neighbors, self.topology.part)
        if contracted is None:
            return None
        V, F, cluster = contracted
        from .preparation import rest_mesh

        coarse = rest_mesh(V, F, PAPER)
        at = cluster if coarse.input_map.order is None else coarse.place[1][cluster]
        return Coarsening(coarse.with_links(self.links.mapped(at)), cluster)


@dataclass(frozen=True, eq=False, repr=False)
class Coarsening(Value):
    """A coarser mesh of the same shape."""

    rest: RestMesh
    cluster: IntArray
    """(n,) int vertex of the coarser mesh into which each vertex was merged"""
