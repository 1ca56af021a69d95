# SPDX-License-Identifier: GPL-3.0-or-later
"""Almost flat sides of a shape become exactly flat: a crisp, low-poly look.

Each vertex goes to the nearest point in the planes of its facets, which one linear calculation
finds. Nothing has to converge, and the same input always gives the same bits.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import BoolArray, Faces, FloatArray, IntArray
from ..errors import CubicCraftError
from ..inputs import real_numbers
from ..mesh.components import components
from ..mesh.edge_vectors import area_vectors
from ..mesh.edges import Edges
from ..mesh.face_graph import FaceGraph
from ..mesh.mesh_checks import check_mesh
from ..mesh.nearest_on_planes import MOST, nearest_on_planes
from ..mesh.unit_box import unit_box
from ..proxy.weld import weld
from ..values import Value
from .regions import nearest_labels

FEWEST = 3
"""triangles of a facet; fewer are a detail, not a side"""
LEAN = 0.55
"""of the sine of the angle: the most that the triangles of a facet lean, as root mean square. Those
of a slice of a cylinder lean by 0.58, evenly up to the angle, and no side is to be cut into such"""
_LEAST_AREA = 1e-6
"""of the area of a triangle before; one that keeps less has collapsed or turned over"""


@dataclass(frozen=True, eq=False, repr=False)
class Flattened(Value):
    """A shape with planar facets, as `flatten_facets` returns it.

    Examples
    --------
    >>> from solver import ball, flatten_facets
    >>> flatten_facets(*ball(), [[0, 0, 1]], angle=0.3, tolerance=0.02).deviation < 1e-12
    True
    """

    positions: FloatArray
    """(n,3) float64, in the unit of the input"""
    facet_of: IntArray
    """(m,) int, the planar facet that each triangle lies in, or -1"""
    normals: FloatArray
    """(f,3) unit normals of the planar facets, each exactly one of the directions"""
    offsets: FloatArray
    """(f,) distances of their planes from the origin"""
    corners: IntArray
    """(p,2) int, the vertices of the facets: each vertex with a facet that it lies in; of vertices
    at the same place, the first"""
    moved: int
    """number of vertices that were moved"""
    largest_move: float
    """largest distance that a vertex was moved by"""

    @property
    def count(self) -> int:
        """Number of planar facets."""
        return len(self.normals)

    @property
    def deviation(self) -> float:
        """Largest distance of a vertex from the plane of its facet: a rounding error."""
        return self.deviation_of(self.positions)

    def deviation_of(self, positions: FloatArray) -> float:
        """Return the same for other positions (n,3), for example rounded ones."""
        vertex, facet = self.corners.T
        heights = np.einsum("pj,pj->p", positions[vertex], self.normals[facet])
        return float(np.abs(heights - self.offsets[facet]).max(initial=0.0))


def flatten_facets(
    positions: ArrayLike,
    triangles: Faces,
    directions: ArrayLike,
    angle: float,
    tolerance: float,
    walls: Iterable[tuple[BoolArray, ArrayLike]] = (),
    counts: BoolArray | None = None,
) -> Flattened:
    """Make the almost flat sides of a shape exactly planar.

    Connected triangles whose normals are nearest to the same direction, and within the angle of it,
    form a patch; between two directions they go with their neighbors, so that borders are short.
    The plane of a patch is orthogonal to the direction and goes through the centroid of its area.
    Its triangles with all corners within the tolerance of that plane become a facet, unless they
    lean by all angles alike, as a slice of a tube does, which stays round. Each corner
    moves to the nearest point in the planes of its facets, of which there may be three: the
    vertices between two facets end up on a straight edge.

    Parameters
    ----------
    positions : (n,3) array_like of float
        The shape, any unit. Vertices at the same place move together.
    triangles : (m,3) array_like of int
        Its triangles.
    directions : (k,3) array_like of float
        The outward normals of the sides that it should have.
    angle : float
        Largest angle between a triangle and its direction, in radians, from 0 to pi/2.
    tolerance : float
        Largest distance from its plane that a vertex may have, and that it may be moved by, in the
        unit of the positions.
    walls : sequence of ((n,) bool array, (3,) array_like), optional
        Vertices that may move only along a plane, such as that of a mirror, and its normal.
    counts : (m,k) bool array, optional
        Which directions each triangle may face; by default all.

    Returns
    -------
    Flattened

    Raises
    ------
    CubicCraftError
        As `check_mesh`; directions that are not (k,3), finite and different from zero; an angle
        or a tolerance out of range.

    Notes
    -----
    Where a vertex belongs to several facets, the larger ones come first. A facet is left out if its
    plane is almost parallel to the earlier ones, or if the vertex would move farther than the
    tolerance. If a triangle would turn over or collapse, its corners keep to their largest facet,
    and stay where they are if that does not help. Only triangles that lie in the plane of a
    facet with all corners, and at least three of them, count as planar.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import flatten_facets
    >>> V = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 0.1]])
    >>> F = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> flat = flatten_facets(V, F, [[0, 0, 1]], angle=0.3, tolerance=0.2)
    >>> flat.count, flat.moved, bool(np.ptp(flat.positions[:, 2]) < 1e-12)
    (1, 5, True)
    """
    V, F = check_mesh(positions, triangles)
    N = _unit_directions(directions)
    if not 0.0 <= angle <= np.pi / 2:
        raise CubicCraftError("the angle must be between 0 and a right angle")
    if not 0.0 <= tolerance < np.inf:
        raise CubicCraftError("the tolerance must be finite and not negative")
    group, first, _ = weld(unit_box(V).to_unit(V), F)
    W, G = V[first], group[F]
    walls = [(is_inside[first], _unit_directions([normal])[0]) for is_inside, normal in walls]
    patches = _Patches(W, G, N, angle, tolerance, counts)
    moved, is_in = _without_turning_over(W, G, patches, tolerance, walls)
    is_moved = (moved != W).any(axis=1)
    lengths = np.linalg.norm(moved - W, axis=1)
    result = np.where(is_moved[group, None], moved[group], V)
    facet_of, kept = _planar(G, patches, is_in)
    vertex, facet = patches.vertex[is_in], np.full(patches.count, -1)
    facet[kept] = np.arange(len(kept))
    facet = facet[patches.patch[is_in]]
    vertex, facet = vertex[facet >= 0], facet[facet >= 0]
    return Flattened(
        result,
        facet_of,
        N[patches.direction[kept]],
        patches.offset[kept],
        np.stack([first[vertex], facet], axis=1),
        int(np.count_nonzero(is_moved[group])),
        float(lengths.max(initial=0.0)),
    )


class _Patches:
    """Almost flat parts of a surface, the largest first, with their planes and vertices.

    `of_triangle`: (m,) int, the patch of each triangle, or -1. `direction`, `offset`: (f,), of each
    patch. `vertex`, `patch`: (p,) int, the vertices of each patch, in ascending order; the patches
    of each vertex likewise.
    """

    def __init__(self, V, F, directions, angle, tolerance, counts):
        areas, centroids, nearest, squared_sines = _facing(V, F, directions, np.cos(angle), counts)
        one, other = Edges(F, len(V)).triangles()
        is_same = (nearest[one] == nearest[other]) & (nearest[one] >= 0)
        pairs = np.stack([one[is_same], other[is_same]], axis=1)
        _, label = components(pairs, len(F))
        area = np.bincount(label, areas)
        heights = np.einsum("mj,mj->m", centroids, directions[nearest])
        offset = np.bincount(label, areas * heights) / np.where(area > 0.0, area, 1.0)
        corners = np.einsum("mcj,mj->mc", V[F], directions[nearest]) - offset[label][:, None]
        is_near = (nearest >= 0) & (np.abs(corners) <= tolerance).all(axis=1)
        is_kept = np.bincount(label[is_near], minlength=len(area)) >= FEWEST
        size = np.bincount(label[is_near], areas[is_near], len(area))
        leaning = np.bincount(label[is_near], (areas * squared_sines)[is_near], len(area))
        is_kept &= leaning <= (LEAN * np.sin(angle)) ** 2 * size
        is_near &= is_kept[label]
        kept = np.flatnonzero(is_kept)
        kept = kept[np.argsort(-size[kept], kind="stable")]
        number = np.full(len(area), -1)
        number[kept] = np.arange(len(kept))
        self.count = len(kept)
        self.of_triangle = np.where(is_near, number[label], -1)
        self.offset = offset[kept]
        self.direction = np.empty(len(kept), dtype=np.intp)
        self.direction[self.of_triangle[is_near]] = nearest[is_near]
        keys = F[is_near].astype(np.int64) * max(self.count, 1)
        keys = np.unique(keys + self.of_triangle[is_near, None])
        self.vertex, self.patch = np.divmod(keys, max(self.count, 1))
        self.normals = directions[self.direction]


def _unit_directions(directions):
    directions = real_numbers(directions, "directions").copy()
    if directions.ndim != 2 or directions.shape[1] != 3 or not len(directions):
        raise CubicCraftError(f"directions must have the shape (k, 3), not {directions.shape}")
    lengths = np.linalg.norm(directions, axis=1)
    if not (np.isfinite(lengths).all() and (lengths > 0.0).all()):
        raise CubicCraftError("directions must be finite and not zero")
    is_unit = np.abs(lengths - 1.0) <= 1e-12  # these keep their bits
    return directions / np.where(is_unit, 1.0, lengths)[:, None]


def _facing(V, F, directions, least_cosine, counts):
    """Return areas and centroids of triangles, the direction that each faces, or -1, and sin^2."""
    vectors = area_vectors(V, F)
    lengths = np.linalg.norm(vectors, axis=1)
    cosines = vectors @ directions.T
    nearest = nearest_labels(FaceGraph(V, F), directions, counts)
    rows = np.arange(len(F))
    is_facing = (cosines[rows, nearest] >= least_cosine * lengths) & (lengths > 0.0)
    if counts is not None:
        is_facing &= counts[rows, nearest]
    cosine = cosines[rows, nearest] / np.where(lengths > 0.0, lengths, 1.0)
    facing = np.where(is_facing, nearest, -1)
    return lengths / 2.0, V[F].mean(axis=1), facing, 1.0 - np.minimum(cosine * cosine, 1.0)


def _without_turning_over(V, F, patches, tolerance, walls):
    """Move the vertices into their planes, those of triangles that turn over into fewer or none."""
    most = np.full(len(V), MOST)
    before = area_vectors(V, F)
    least = _LEAST_AREA * np.einsum("mj,mj->m", before, before)
    planes = patches.vertex, patches.patch, patches.normals, patches.offset
    while True:
        moved, is_in = nearest_on_planes(V, *planes, most, tolerance, walls)
        kept = np.einsum("mj,mj->m", before, area_vectors(moved, F))
        is_turned = (kept < least) & (moved != V).any(axis=1)[F].any(axis=1)
        if not is_turned.any():
            return moved, is_in
        corners = F[is_turned]
        is_single = (most[corners] <= 1).all(axis=1)
        most[corners[~is_single]] = np.minimum(most[corners[~is_single]], 1)
        most[corners[is_single]] = 0


def _planar(F, patches, is_in):
    key = patches.vertex[is_in] * max(patches.count, 1) + patches.patch[is_in]
    wanted = F.astype(np.int64) * max(patches.count, 1) + patches.of_triangle[:, None]
    is_planar = (patches.of_triangle >= 0) & np.isin(wanted, key).all(axis=1)
    sizes = np.bincount(patches.of_triangle[is_planar], minlength=patches.count)
    kept = np.flatnonzero(sizes >= FEWEST)
    number = np.full(patches.count + 1, -1)
    number[kept] = np.arange(len(kept))
    return np.where(is_planar, number[patches.of_triangle], -1), kept
