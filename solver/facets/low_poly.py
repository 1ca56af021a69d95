# SPDX-License-Identifier: GPL-3.0-or-later
"""A shape as few planar polygons, one for each of its sides where that can be."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike
from scipy.sparse.csgraph import dijkstra

from ..aliases import BoolArray, Faces, FloatArray, IntArray
from ..mesh.face_graph import FaceGraph
from ..mesh.mesh_checks import check_mesh
from ..mesh.unit_box import unit_box
from ..proxy.weld import weld
from ..values import Value
from .corners import FLATNESS, Corners
from .joining import straightened
from .polygons import filled
from .regions import regions_of

STRAY = 0.5
"""of the tolerance: how far a side may stray from its plane"""


@dataclass(frozen=True, eq=False, repr=False)
class LowPoly(Value):
    """Few polygons in place of many triangles, as `low_poly` returns them.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import ball, low_poly
    >>> low = low_poly(*ball(), np.concatenate([np.eye(3), -np.eye(3)]), 0.1)
    >>> len(low.polygons) == len(low.part_of)
    True
    """

    positions: FloatArray
    """(n,3) of all vertices, in the unit of the input; those in no polygon stay where they were"""
    polygons: list[list[int]]
    """the vertices of each polygon, counterclockwise; of vertices at the same place, the first"""
    part_of: list[int]
    """the part of the surface that each polygon is of"""
    region_of: list[int]
    """its side; several parts may be of one"""
    parts: IntArray
    """(m,) the part of each triangle"""
    places: IntArray
    """(n,) of vertices at the same place, the first"""


def low_poly(
    positions: ArrayLike,
    triangles: Faces,
    directions: FloatArray,
    tolerance: float,
    walls: Iterable[tuple[BoolArray, FloatArray]] = (),
    counts: BoolArray | None = None,
    charts: IntArray | None = None,
    cuts: IntArray | None = None,
) -> LowPoly:
    """Replace the sides of a shape by polygons.

    Parameters
    ----------
    positions, triangles, directions, tolerance, walls, counts
        As of `flatten_facets`, which makes the sides of the triangles themselves planar; the
        directions are unit vectors.
    charts : (m,) int array, optional
        Polygons end between triangles of different ones, such as those of two materials.
    cuts : (c,2) int array, optional
        Pairs of neighbors between which polygons end within a chart too, as at a seam that does not
        go around it.

    Raises
    ------
    CubicCraftError
        As `flatten_facets`.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import low_poly
    >>> V = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
    >>> sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    >>> F = np.array([[a, b, c] for a, b, c, d in sides] + [[a, c, d] for a, b, c, d in sides])
    >>> low = low_poly(V, F, np.concatenate([np.eye(3), -np.eye(3)]), 0.02)
    >>> len(F), sorted(map(len, low.polygons))
    (12, [4, 4, 4, 4, 4, 4])
    """
    V, F = check_mesh(positions, triangles)
    box = unit_box(V)
    group, first, _ = weld(box.to_unit(V), F)
    W, G = box.to_unit(V[first]), group[F]
    graph = FaceGraph(W, G)
    tolerance /= box.size
    regions = regions_of(W, G, graph, directions, STRAY * tolerance, counts)
    walls = [(is_inside[first], normal / np.linalg.norm(normal)) for is_inside, normal in walls]
    charts = np.zeros(len(G), np.int64) if charts is None else charts
    cuts = np.empty((0, 2), np.int64) if cuts is None else cuts
    parts, charts = _parts_of(graph, regions.of_triangle, charts, cuts)
    corners = Corners(W, G, graph, regions, parts, tolerance, walls)
    P = corners.positions
    found = {}
    for part, around in corners.loops.items():
        for loop in filled(P, around, corners.normals[part], FLATNESS):
            back = found.pop(frozenset(loop), None)  # of a wall without thickness: both go
            if back is None:
                found[frozenset(loop)] = loop, part
    loops, part_of = ([pair[k] for pair in found.values()] for k in (0, 1))
    about = np.zeros((parts.max() + 1, 2), np.int64)  # the region and the chart of each part
    about[parts, 0] = regions.of_triangle
    about[parts, 1] = charts
    loops, kept = straightened(P, loops, about[part_of, 1].tolist(), FLATNESS)
    part_of = [part_of[k] for k in kept]
    loops = corners.anchored(loops)
    result = V.copy()
    used = sorted({v for loop in loops for v in loop})
    result[first[used]] = box.from_unit(P[used])
    polygons = [first[loop].tolist() for loop in loops]
    region_of = about[part_of, 0].tolist()
    return LowPoly(result, polygons, part_of, region_of, parts, first[group])


def _parts_of(graph, region, charts, cuts):
    """Return the connected parts (m,) of one region and one chart, and their charts (m,).

    A part that lies on both sides of a cut, as around the end of a seam, is divided half-way
    between these: its polygons would bridge the cut. The second half is a chart of its own.

    `graph`: FaceGraph. `region`, `charts`: (m,). `cuts`: (c,2) int, as of `low_poly`.
    """
    m, charts = len(region), charts.copy()
    is_same = region[graph.one] == region[graph.other]
    is_same &= charts[graph.one] == charts[graph.other]
    lower, upper = np.minimum(graph.one, graph.other), np.maximum(graph.one, graph.other)
    cuts = np.sort(np.asarray(cuts, dtype=np.int64), axis=1)
    is_same &= ~np.isin(lower.astype(np.int64) * m + upper, cuts[:, 0] * m + cuts[:, 1])
    part = graph.regions(is_same)[1]
    while True:
        both = cuts[part[cuts[:, 0]] == part[cuts[:, 1]]]
        if not len(both):
            return part, charts
        both = both[np.unique(part[both[:, 0]], return_index=True)[1]]
        ends = graph.one[is_same], graph.other[is_same]
        lengths = sp.csr_matrix((graph.distance[is_same], ends), shape=(m, m))
        far = [dijkstra(lengths, directed=False, indices=side, min_only=True) for side in both.T]
        is_second = far[1] < far[0]
        charts[is_second] = charts.max() + 1 + part[is_second]
        is_same &= is_second[graph.one] == is_second[graph.other]
        part = graph.regions(is_same)[1]
