# SPDX-License-Identifier: GPL-3.0-or-later
"""A piece of plain arrays, for callers without an object in Blender."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import Faces
from ..errors import CubicCraftError
from ..inputs import instance, instances, matrix_of, real_numbers, switch, whole_numbers
from ..mesh.mesh_checks import check_mesh, check_winding, faces_of_triangles
from ..styles.style import CRISPNESS, Style
from .handle_pose import HandlePose
from .piece import Piece
from .placement import placement_by
from .reach import rest_weights
from .reflection import Reflection
from .shape import Shape

_ROUNDING = 1e-4  # of shares that add up to 1, which may be of 32 bits


def piece_of(
    V: ArrayLike,
    F: Faces,
    style: Style | None = None,
    *,
    name: str = "mesh",
    matrix: ArrayLike | None = None,
    mirrors: Sequence[Reflection] = (),
    symmetry: Sequence[bool] = (False, False, False),
    handles: Sequence[HandlePose] = (),
    handle_of: ArrayLike | None = None,
    hold_rest: bool = False,
    regions: Sequence[Style] = (),
    region_shares: ArrayLike | None = None,
    map_weights: ArrayLike | None = None,
    detail_weights: ArrayLike | None = None,
) -> Piece:
    """Return an object as a piece that is solved in the coordinates of the world.

    Parameters
    ----------
    V : (n,3) array
        Rest positions, in the coordinates of the object.
    F : (m,3) int array, or faces with more corners
        Triangles. Polygons are split into triangles.
    style : Style, optional
        What it is turned toward, the same for all vertices; by default a crisp cube of cubeness 0.4
        along the axes of the world.
    name : str
        For messages.
    matrix : (4,4) array, optional
        From the coordinates of the object to those of the world.
    mirrors : sequence of Reflection
        Reflections that complete a half, one after the other. The images are solved with it, and
        not returned.
    symmetry : sequence of bool
        About which axes of the object the mesh itself stays symmetric.
    handles : sequence of HandlePose
    handle_of : (n,) int array, optional
        Number of the handle that each vertex belongs to, or -1.
    hold_rest : bool
        Whether regions far from moved handles keep their place.
    regions : sequence of Style
    region_shares : (n,1+k) array, optional
        Shares of the object's own style and of each region; each row adds up to 1.
    map_weights : (n,) array, optional
        Factors of the cubeness and of the crispness.
    detail_weights : (n,) array, optional
        Factors of the strength of details.

    Raises
    ------
    CubicCraftError
        The mesh is invalid, an array has another shape or other values than it asks for, a vertex
        belongs to a handle that is not there, or a style differs from vertex to vertex.

    Examples
    --------
    A mirror completes a half, with which it is solved:

    >>> import numpy as np
    >>> from solver import HandlePose, SolverOptions, Style, ball, flip, join_pieces, piece_of, run
    >>> half = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3]])
    >>> piece = piece_of(half, F, mirrors=[flip(0)])
    >>> piece.vertices, piece.solved, len(piece.F)
    (4, 5, 6)

    A region has a style of its own, here the upper half of a ball that becomes an octahedron; and a
    handle moves its vertices, here those at the bottom:

    >>> V, F = ball()
    >>> shares = np.eye(2)[np.where(V[:, 2] > 0, 1, 0)]  # of the style, and of the region
    >>> gem = piece_of(V, F, regions=[Style(0.6, form="octahedron")], region_shares=shares)
    >>> down = np.eye(4)
    >>> down[2, 3] = -0.5
    >>> of_handle = np.where(V[:, 2] < -0.9, 0, -1)
    >>> pulled = piece_of(V, F, handles=[HandlePose(matrix=down)], handle_of=of_handle)
    >>> options = SolverOptions(keep_rotation=True, device="numpy")
    >>> for piece in (gem, pulled):
    ...     problem = join_pieces([piece])
    ...     result = run(problem.stylization(options))
    ...     ((positions, _),) = problem.split(result.positions, result.rotations)
    ...     print(f"from {positions[:, 2].min():.2f} to {positions[:, 2].max():.2f}")
    from -0.63 to 1.34
    from -1.50 to 0.05
    """
    original, triangles = check_mesh(V, F)
    check_winding(triangles, len(original))
    count = len(original)
    own = _uniform(Style(0.4, crispness=CRISPNESS) if style is None else style, "style")
    regions = _several(regions, "regions", Style)
    handles = _several(handles, "handles", HandlePose)
    others = [_uniform(region, "regions") for region in regions]
    place = matrix_of(np.eye(4) if matrix is None else matrix, "matrix")
    if abs(np.linalg.det(place[:3, :3])) == 0.0:
        raise CubicCraftError("matrix flattens the object: a scale is zero; give another one")
    numbers = np.full(count, -1) if handle_of is None else whole_numbers(handle_of, "handle_of")
    _check(numbers.shape, "handle_of", (count,))
    if numbers.min() < -1 or numbers.max() >= len(handles):
        raise CubicCraftError(
            f"handle_of refers to handles {numbers.min()} to {numbers.max()}, but there are only"
            f" {len(handles)}; -1 is for none"
        )
    if np.shape(symmetry) != (3,):
        raise CubicCraftError("symmetry must be True or False for each of the three axes")
    shape = Shape(original, triangles, faces=faces_of_triangles(F))
    placement = placement_by(place, (own, *others))
    far = None
    if switch(hold_rest, "hold_rest"):
        far = rest_weights(handles, numbers, placement.place(original), triangles)
    axes = tuple(switch(axis, "symmetry") for axis in symmetry)
    return Piece(
        name=name,
        shape=shape,
        whole=shape.whole(tuple(_several(mirrors, "mirrors", Reflection)), axes, is_smooth=False),
        placement=placement,
        handles=tuple(handles),
        handle_of=numbers,
        rest_weights=far,
        map_weights=_factors(map_weights, "map_weights", count),
        detail_weights=_factors(detail_weights, "detail_weights", count),
        region_shares=_shares(region_shares, count, len(regions)),
    )


def _several(values, name, kind):
    """Return values of a class of ours as a list, which may be empty."""
    if isinstance(values, kind):
        raise CubicCraftError(f"{name} must be a list, even of one: give [{name}]")
    return instances(values, name, kind) if len(values) else []


def _factors(values, name, count):
    if values is None:
        return 1.0
    factors = real_numbers(values, name)
    _check(factors.shape, name, (), (count,))
    if not np.isfinite(factors).all() or (factors < 0.0).any():
        raise CubicCraftError(f"{name} must be finite and not negative")
    return factors if factors.ndim else float(factors)


def _shares(values, count, regions):
    """Return shares (n,1+k) of the style and of regions, None if there are none."""
    expected = (count, 1 + regions)
    if values is None:
        if regions:
            raise CubicCraftError(f"regions need region_shares, an array of shape {expected}")
        return None
    if not regions:
        raise CubicCraftError("region_shares needs regions, a list of styles")
    shares = real_numbers(values, "region_shares")
    _check(shares.shape, "region_shares", expected)
    if not (np.abs(shares.sum(axis=1) - 1.0) < _ROUNDING).all() or (shares < 0.0).any():
        raise CubicCraftError(
            "each row of region_shares must add up to 1, without negative ones; divide by the sums"
        )
    return shares


def _uniform(style, name):
    forms = instance(style, name, Style).forms
    numbers = style.cubeness, style.crispness, style.detail_strength
    is_one = not any(map(np.ndim, numbers)) and np.shape(style.orientation) == (3, 3)
    if not is_one or len(forms) > 1:
        raise CubicCraftError(
            f"{name} must be the same for all vertices of a piece; use map_weights or regions"
        )
    return replace(style, form=next(iter(forms), None), form_of=None)


def _check(shape, name, *expected):
    if shape not in expected:
        shapes = " or ".join(map(str, expected))
        raise CubicCraftError(f"{name} must be an array of shape {shapes}, not {shape}")
