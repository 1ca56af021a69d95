# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that is computed once per mesh, regardless of cubeness, orientation and pins."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .contraction import contract
from .cotangents import cotangents
from .memory import check_memory
from .mesh_checks import check_mesh
from .proxy import PAPER, InputMap, Links, ProxyOptions, no_links, surface_of
from .proxy.boxes import box_frames
from .proxy.creases import cubic_shares
from .proxy.flat_sides import stiffness
from .proxy.neighbours import neighbour_links
from .proxy.thickness import outward_sign, thickness_links
from .rest_measures import areas_and_normals
from .spokes_and_rims import SpokesAndRims, spokes_and_rims
from .topology import Topology, topology
from .triangles import Triangles
from .unit_box import UnitBox


@dataclass(frozen=True)
class RestMesh:
    """The rest shape in the unit box: the proxy of the input, without its loose vertices.

    The arrays are indexed by the `n` vertices that are solved; `input_map` maps between them and
    the `N` vertices of the input.

    See Also
    --------
    rest_mesh : Builds it.

    Examples
    --------
    >>> from solver import rest_mesh
    >>> rest = rest_mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0], [9, 9, 9]], [[0, 1, 2]])
    >>> rest.V.shape, rest.input_positions.shape  # the last vertex is loose
    ((3, 3), (4, 3))
    """

    input_positions: np.ndarray
    """(N,3) float64 rest positions as given, loose vertices included"""
    input_map: InputMap
    box: UnitBox
    V: np.ndarray
    """(n,3) float64 rest positions in the unit box"""
    topology: Topology
    areas: np.ndarray
    """(n,) barycentric areas a_i"""
    normals: np.ndarray
    """(n,3) unit normals n_i, zero where undefined"""
    cubic_shares: np.ndarray
    """(n,) factors of the cubeness: 0 in creases, more than 1 beside them"""
    to_neighbours: Links
    to_other_side: Links | None
    """for a solidity of 1; None if they have not been computed"""
    solidity: float
    is_refined: bool
    cotangents: np.ndarray
    """(m,3) weight of the edge opposite each corner of the triangles"""
    skin: SpokesAndRims
    """of the triangles only"""
    matrices: SpokesAndRims
    """including the links"""

    @property
    def F(self):  # noqa: N802 - as everywhere
        """(m,3) int32 triangles."""
        return self.topology.F

    @cached_property
    def used(self):
        """(n,) int vertex of the input that represents each solved vertex."""
        return self.input_map.source

    @cached_property
    def place(self):
        """Vertices of the input that are solved, and the solved vertex of each of them."""
        return self.input_map.place()

    @cached_property
    def box_frames(self):
        """(n,3,3) frames of parts that are already boxes, see `proxy/boxes.py`, or None."""
        return box_frames(self.V, self.F, self.topology.part) if self.is_refined else None

    @cached_property
    def facing_outward(self):
        """The same mesh with the normals of inside-out parts turned around.

        The cube does not care; a pyramid would come out upside down.
        """
        sign = outward_sign(Triangles(self.V, self.F), self.topology.part)
        is_inward = (sign < 0.0)[self.topology.part]
        return replace(self, normals=np.where(is_inward[:, None], -self.normals, self.normals))

    @cached_property
    def standing(self):
        """(n,) weights of the vertices in the rotation of a component.

        In the paper's energy, they are the areas. Otherwise they are the fourth roots of the areas,
        nearly a count of vertices: a rotation is noticeable where an artist has put many vertices,
        as in a face, but the tiny triangles of a zip must not turn a coat.
        """
        return (np.sqrt(np.sqrt(self.areas)) if self.is_refined else self.areas) + 1e-300

    @property
    def links(self):
        """All links, with their weights."""
        if self.to_other_side is None:
            return self.to_neighbours
        return self.to_neighbours.joined(self.to_other_side.scaled(self.solidity))

    def with_solidity(self, solidity):
        """Return the RestMesh with another solidity, without a new search for links."""
        if solidity == self.solidity:
            return self
        to_other_side = self.to_other_side
        if to_other_side is None:
            triangles, part = Triangles(self.V, self.F), self.topology.part
            to_other_side = thickness_links(triangles, self.normals, self.areas, part)
        changed = replace(self, to_other_side=to_other_side, solidity=solidity)
        return replace(changed, matrices=changed.skin.with_links(self.V, changed.links))

    def posed(self, input_positions):
        """Return the same mesh in another pose, with all weights and links of this one.

        Its Laplacian is the same, so what has been factorised can be reused.

        Parameters
        ----------
        input_positions : (N,3) numpy array
        """
        positions = np.array(input_positions, dtype=np.float64)
        V = self.input_map.points(self.box.to_unit(positions))
        areas, normals = areas_and_normals(V, self.F)
        skin = spokes_and_rims(V, self.F, self.cotangents)
        posed = replace(
            self, input_positions=positions, V=V, areas=areas, normals=normals, skin=skin
        )
        return replace(posed, matrices=skin.with_links(V, posed.links))

    @cached_property
    def edge_sums(self):
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
        return self.topology.sum_parts_at(i, weighted)

    @cached_property
    def energy_terms(self):
        """(n,) 0.75 sum w |d|^2 - tr S of each vertex at rest, where the ARAP energy is 0."""
        m, V = self.matrices, self.V
        L = m.matrix(m.laplacian)
        quadratic = 2.0 * (V * (L @ V)).sum(axis=1) - L @ (V * V).sum(axis=1)
        trace = sum(m.matrix(m.gather[:, c]) @ V[:, c] for c in range(3))
        return 0.75 * quadratic - trace

    @cached_property
    def coarse(self):
        """The Coarsening, or None if it is not available."""
        neighbours = self.skin.matrix(self.skin.laplacian)
        contracted = contract(self.V, self.F, neighbours, self.topology.part)
        if contracted is None:
            return None
        V, F, cluster = contracted
        coarse = rest_mesh(V, F)
        at = cluster if coarse.input_map.order is None else coarse.place[1][cluster]
        return Coarsening(coarse._linked(self.links.mapped(at)), cluster)

    def _linked(self, links):
        """Return the mesh with other links."""
        if not len(links):
            return self
        return replace(
            self,
            topology=self.topology.linked(links.pairs()),
            to_neighbours=links,
            matrices=self.matrices.with_links(self.V, links),
        )


@dataclass(frozen=True)
class Coarsening:
    """A coarser mesh of the same shape."""

    rest: RestMesh
    cluster: np.ndarray
    """(n,) int vertex of the coarser mesh into which each vertex was merged"""


def rest_mesh(V: ArrayLike, F: ArrayLike, proxy: ProxyOptions = PAPER) -> RestMesh:
    """Build the RestMesh of a mesh.

    Parameters
    ----------
    V : (N,3) numpy array
        Rest positions, in any unit.
    F : (m,3) numpy int array
        Triangles.
    proxy : ProxyOptions
        How to prepare the surface; by default nothing is done, as in the paper.

    Returns
    -------
    RestMesh

    Raises
    ------
    CubicCraftError
        The mesh is invalid, or needs more memory than is free.

    See Also
    --------
    Setup : The next step, for a set of pinned vertices.

    Notes
    -----
    The weights are the cotangents of Pinkall and Polthier, "Computing Discrete Minimal Surfaces and
    Their Conjugates", Experimental Mathematics 2(1), 1993.

    Examples
    --------
    >>> from solver import ProxyOptions, rest_mesh
    >>> V, F = [[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]]
    >>> len(rest_mesh(V, F).V), len(rest_mesh(V, F, ProxyOptions()).V) > 3
    (3, True)
    """
    input_positions, F = check_mesh(V, F)
    check_memory(len(input_positions), len(F))
    surface = surface_of(input_positions, F, proxy)
    V, F = surface.V, surface.F
    triangles = Triangles(V, F)
    areas, normals = areas_and_normals(V, F, triangles.measures)
    C = cotangents(V, F)
    parts = topology(F, len(V))
    with ThreadPoolExecutor(1) as beside:  # most of the search lets other threads compute
        to_neighbours, search = no_links(), None
        if proxy.solidity > 0.0:
            search = beside.submit(thickness_links, triangles, normals, areas, parts.part)
        if proxy.together:
            to_neighbours = neighbour_links(V, F, normals, areas, parts.part, parts.component_count)
        shares = np.ones(len(V))
        if proxy.refine:
            shares = cubic_shares(triangles, C, areas)
            C = C * stiffness(triangles, parts.part)[:, None]
        skin = spokes_and_rims(V, F, C, triangles.edges)
        to_other_side = search.result() if search else None
    rest = RestMesh(
        input_positions,
        surface.input_map,
        surface.box,
        V,
        parts.linked(to_neighbours.pairs()),
        areas,
        normals,
        shares,
        to_neighbours,
        to_other_side,
        proxy.solidity,
        proxy.refine,
        C,
        skin,
        skin,
    )
    return replace(rest, matrices=skin.with_links(V, rest.links))
