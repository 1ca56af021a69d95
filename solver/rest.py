# SPDX-License-Identifier: GPL-3.0-or-later
"""All that is computed once per mesh, whatever the cubeness, orientation or pins."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .components import components
from .cotangents import cotangents
from .decimation import decimate
from .memory import check_memory
from .mesh_checks import check_mesh
from .rest_measures import areas_and_normals
from .spokes_and_rims import SpokesAndRims, spokes_and_rims
from .unit_box import UnitBox, unit_box
from .vertex_order import vertex_order

COARSENING = 16
"""triangles of a mesh for each triangle of its coarser mesh"""

_CHUNK = 256


@dataclass(frozen=True)
class RestMesh:
    """The rest shape in the unit box, without its loose vertices.

    The arrays are indexed by the `n` vertices that lie in a triangle; `used` maps them to the
    vertices of the input.
    """

    input_positions: np.ndarray
    """(N,3) float64 rest positions as given, loose vertices included"""
    used: np.ndarray
    """(n,) int vertices of the input that lie in a triangle; ascending, unless the mesh is large"""
    box: UnitBox
    V: np.ndarray
    """(n,3) float64 rest positions in the unit box"""
    F: np.ndarray
    """(m,3) int32 triangles"""
    areas: np.ndarray
    """(n,) barycentric areas a_i"""
    normals: np.ndarray
    """(n,3) unit normals n_i, zero where undefined"""
    matrices: SpokesAndRims
    component_count: int
    component: np.ndarray
    """(n,) int component of each vertex"""

    @cached_property
    def edge_sums(self):
        """sum_ij w_ij |v_j - v_i|^2 over the ordered pairs of each component, as `sum_parts`."""
        matrices = self.matrices
        rows = np.repeat(np.arange(len(self.V), dtype=np.int32), np.diff(matrices.indptr))
        is_upper = matrices.indices > rows  # each pair is counted once, then twice
        i, j = rows[is_upper], matrices.indices[is_upper]
        squares = np.zeros(len(i))
        for x in self.V.T.copy():
            difference = x.take(j) - x.take(i)
            squares += difference * difference
        weighted = -2.0 * matrices.laplacian[is_upper] * squares
        return np.bincount(self.component[i], weighted, self.component_count)

    @cached_property
    def coarse(self):
        """The Coarsening, or None where it cannot be had."""
        decimated = decimate(self.V, self.F, COARSENING)
        if decimated is None:
            return None
        V, F, cluster = decimated
        return Coarsening(rest_mesh(V, F), cluster)

    @cached_property
    def chunks(self):
        """Up to 256 vertices each, one after the other and of one component, for sums in parallel.

        (k+1,) int32 where each begins, and (k,) int32 the component of each.
        """
        is_start = np.zeros(len(self.V), dtype=bool)
        is_start[::_CHUNK] = True
        is_start[1:] |= self.component[1:] != self.component[:-1]
        start = np.flatnonzero(is_start)
        bounds = np.append(start, len(self.V)).astype(np.int32)
        return bounds, self.component[start].astype(np.int32)

    @cached_property
    def largest_component(self):
        """Number of vertices of the largest component, which says how hard the problem is."""
        return int(np.bincount(self.component).max())

    def sum_parts(self, values):
        """Sum values (n,) over each component, to (component_count,)."""
        if self.component_count == 1:
            return values.sum(keepdims=True)
        return np.bincount(self.component, values, self.component_count)


@dataclass(frozen=True)
class Coarsening:
    """A coarser mesh of the same shape."""

    rest: RestMesh
    cluster: np.ndarray
    """(n,) int vertex of the coarser mesh that each vertex has been merged into"""


def rest_mesh(V, F):
    """Build the RestMesh of positions V (N,3), any unit, and triangles F (m,3).

    Raises
    ------
    CubicCraftError
        See `check_mesh` and `check_memory`.
    """
    input_positions, F = check_mesh(V, F)
    check_memory(len(input_positions), len(F))
    used, F = _ordered(*_used_vertices(F, len(input_positions)))
    V = input_positions[used]
    box = unit_box(V)
    V = box.to_unit(V)
    areas, normals = areas_and_normals(V, F)
    matrices = spokes_and_rims(V, F, cotangents(V, F))
    component_count, component = components(F, len(V))
    return RestMesh(
        input_positions, used, box, V, F, areas, normals, matrices, component_count, component
    )


def _used_vertices(F, count):
    """Return the vertices that lie in a triangle, ascending, and F as indices into them."""
    is_used = np.zeros(count, dtype=bool)
    is_used[F.ravel()] = True
    used = np.flatnonzero(is_used)
    if len(used) == count:
        return used, F.copy()  # it may be the caller's
    number = np.cumsum(is_used, dtype=np.int32) - np.int32(1)
    return used, number[F]


def _ordered(used, F):
    """Put the vertices that are used, and F, in the order of `vertex_order`."""
    order = vertex_order(F, len(used))
    if order is None:
        return used, F
    number = np.empty(len(order), dtype=np.int32)
    number[order] = np.arange(len(order), dtype=np.int32)
    return used[order], number[F]
