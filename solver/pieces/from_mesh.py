# SPDX-License-Identifier: GPL-3.0-or-later
"""A piece of plain arrays, for callers without an object in Blender."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..aliases import Faces
from ..errors import CubicCraftError
from ..inputs import instance, whole_numbers
from ..mesh.mesh_checks import check_mesh
from ..styles.style import Style
from .handle_pose import HandlePose
from .piece import Piece
from .placement import placement_by
from .reach import rest_weights
from .reflection import Reflection
from .shape import Shape
from .whole import Whole


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
        What it is turned toward, the same for all vertices; by default a cube of cubeness 0.4 along
        the axes of the world. Its capture is also that of the regions.
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
        Without captures of their own.
    region_shares : (n,1+k) array, optional
        Shares of the object's own style and of each region; each row adds up to 1.
    map_weights : (n,) array, optional
        Factors of the cubeness, of the strength of the capture and of the crispness.
    detail_weights : (n,) array, optional
        Factors of the strength of details.

    Raises
    ------
    CubicCraftError
        The mesh is invalid, an array has another shape than the mesh asks for, a vertex belongs to
        a handle that is not there, or a style differs from vertex to vertex.

    See Also
    --------
    join_pieces : Joins pieces, to solve them together.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import flip, piece_of
    >>> half = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3]])
    >>> piece = piece_of(half, F, mirrors=[flip(0)])
    >>> piece.vertices, piece.solved, len(piece.F)
    (4, 5, 6)
    """
    original, triangles = check_mesh(V, F)
    count = len(original)
    own = _uniform(Style(0.4) if style is None else style, "style")
    others = [_without_capture(_uniform(region, "regions")) for region in regions]
    placement = placement_by(np.eye(4) if matrix is None else matrix, (own, *others))
    numbers = np.full(count, -1) if handle_of is None else whole_numbers(handle_of, "handle_of")
    shares = None if region_shares is None else np.asarray(region_shares, dtype=np.float64)
    weights = 1.0 if map_weights is None else np.asarray(map_weights, dtype=np.float64)
    _check(numbers.shape == (count,), "handle_of", (count,))
    if numbers.min() < -1 or numbers.max() >= len(handles):
        raise CubicCraftError(
            f"handle_of refers to handles {numbers.min()} to {numbers.max()}, but there are only"
            f" {len(handles)}; -1 is for none"
        )
    _check(np.shape(weights) in ((), (count,)), "map_weights", (count,))
    of_details = 1.0 if detail_weights is None else np.asarray(detail_weights, dtype=np.float64)
    _check(np.shape(of_details) in ((), (count,)), "detail_weights", (count,))
    expected = (count, 1 + len(regions))
    _check((shares is None) == (not regions), "region_shares", expected)
    _check(shares is None or shares.shape == expected, "region_shares", expected)
    far = None
    if hold_rest:
        far = rest_weights(handles, numbers, placement.place(original), triangles)
    return Piece(
        name=name,
        shape=Shape(original, triangles),
        whole=Whole(original, triangles, tuple(mirrors), tuple(symmetry)),
        placement=placement,
        handles=tuple(handles),
        handle_of=numbers,
        rest_weights=far,
        map_weights=weights,
        detail_weights=of_details,
        region_shares=shares,
    )


def _uniform(style, name):
    """Return a Style that is the same for all vertices, with its only form and capture."""
    forms, captures = instance(style, name, Style).forms, style.captures
    numbers = style.cubeness, style.capture_strength, style.crispness, style.detail_strength
    is_one = not any(map(np.ndim, numbers)) and np.shape(style.orientation) == (3, 3)
    if not is_one or len(forms) > 1 or len(captures) > 1:
        raise CubicCraftError(f"{name} must be the same for all vertices of a piece")
    return replace(style, form=next(iter(forms), None), capture=next(iter(captures), None))


def _without_capture(style):
    if style.capture is not None:
        raise CubicCraftError("regions cannot have captures; the one of the style is for all")
    return style


def _check(is_right, name, shape):
    if not is_right:
        raise CubicCraftError(f"{name} must be an array of shape {shape}")
