# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface of a proxy: welded, and fine enough."""

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from ..aliases import FloatArray, IntArray
from ..mesh.components import components
from ..mesh.edges import distinct_rows
from ..mesh.unit_box import UnitBox, unit_box
from .input_map import InputMap
from .refinement import longest_edges, refine
from .sheets import working_extent
from .weld import weld

REORDERED_FROM = 20_000
"""vertices. Smaller meshes fit into the cache in any order."""


@dataclass(frozen=True)
class Surface:
    """The surface that is solved instead of the input, without its loose vertices."""

    input_map: InputMap
    box: UnitBox
    V: FloatArray
    """(n,3) float64 rest positions in the unit box"""
    F: IntArray
    """(m,3) int32 triangles"""
    unrefined: IntArray | None
    """(l,3) int triangles before refinement; None if nothing was refined"""
    pieces: IntArray | None
    """(m,) int that of these which each triangle is a piece of, or None"""
    faces: IntArray | None
    """(l,) int the face, of those given, that each of these is a piece of"""


def surface_of(V, F, options, faces=None) -> Surface:
    """Return the Surface of positions V (N,3), any unit, and triangles F (m,3).

    `options`: ProxyOptions. `faces`: (m,) int, optional, the face of the artist's mesh that each
    triangle is a piece of.
    """
    used, F = _used_vertices(F, len(V))
    box = unit_box(V[used])
    at = box.to_unit(V[used])
    group, first = np.arange(len(used)), np.arange(len(used))
    count, part = components(F, len(at)) if options.together or options.refine else (0, None)
    welding = weld(at, F, part) if options.together else None
    if welding and len(welding[2]):  # of a mesh that nothing would be left of, nothing is welded
        group, first, welded = welding
        if faces is not None and len(welded) < len(F):
            faces = faces[distinct_rows(group[F])]
        F = welded
        if len(first) < len(at):
            at = at[first]
            count, part = components(F, len(at))
    if count > 1:
        extent = working_extent(at, F, part)
        at, box = at / extent, replace(box, size=extent * box.size)
    parents, rounds = np.empty((0, 2), np.int64), np.zeros(1, np.int64)
    unrefined = pieces = None
    if options.refine:
        unrefined, bound = F, longest_edges(at, part)[part]
        at, F, parents, rounds, pieces = refine(at, F, bound, count)
    if not len(parents):
        unrefined = pieces = None
    of_input = np.full(len(V), -1)
    of_input[used] = group
    input_map = InputMap(of_input, used[first], parents, rounds)
    order = _vertex_order(F, len(at))
    if order is not None:
        number = np.empty(len(order), dtype=np.int32)
        number[order] = np.arange(len(order), dtype=np.int32)
        input_map, at, F = replace(input_map, order=order), at[order], number[F]
        unrefined = None if unrefined is None else number[unrefined]
    return Surface(input_map, box, at, F, unrefined, pieces, faces)


def _used_vertices(F, count):
    """Return the vertices that lie in a triangle, ascending, and F as indices into them."""
    is_used = np.zeros(count, dtype=bool)
    is_used[F.ravel()] = True
    used = np.flatnonzero(is_used)
    if len(used) == count:
        return used, F.copy()  # it may be the caller's
    number = np.cumsum(is_used, dtype=np.int32) - np.int32(1)
    return used, number[F]


def _vertex_order(F, n):
    """Return an order (n,) int of vertices with neighbors close to each other, or None to keep it.

    The speed of an iteration depends on memory access to neighbors. Programs that subdivide append
    the new vertices, far from the old ones. In the order of Cuthill and McKee (1969) the set-up,
    the local step and the products with sparse matrices take half the time (400,000 vertices), and
    an iteration a third less (25,000). Vertices of a component come one after the other.

    `F`: (m,3) int.
    """
    if n < REORDERED_FROM:
        return None
    from scipy.sparse.csgraph import reverse_cuthill_mckee  # takes long to import

    start, end = F.ravel(), F[:, [1, 2, 0]].ravel()
    edges = sp.coo_matrix((np.ones(len(start), np.int8), (start, end)), shape=(n, n))
    # a closed surface has each edge in both directions, and any order will do at a boundary
    return reverse_cuthill_mckee(edges.tocsr(), symmetric_mode=True)
