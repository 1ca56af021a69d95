# SPDX-License-Identifier: GPL-3.0-or-later
"""Refuse input that cannot be solved, before anything is computed."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..aliases import Faces, FloatArray, IntArray
from ..errors import CubicCraftError
from ..inputs import array_of, real_numbers, refuse_mask
from .edges import Edges
from .polygons import triangulate

MOST_REVERSED = 0.05
"""share of edges whose two triangles face opposite ways; single ones are common, and do no harm"""


def check_mesh(V: ArrayLike, F: Faces) -> tuple[FloatArray, NDArray[np.int32]]:
    """Return the mesh as contiguous arrays, or raise an error that says what is wrong with it.

    `V`: (n,3) array_like of float, vertex positions, any unit. `F`: (m,3) array_like of int, or
    faces with more corners, triangles, as indices into V. Polygons (m,s), or rows of any length,
    are split into triangles, block by block of the same number of corners. Returns `V`: (n,3); `F`:
    (m,3) int32. Raises CubicCraftError: wrong shapes or types, no faces, fewer than 3 vertices,
    non-finite positions, indices out of range, a polygon that has a vertex twice.
    """
    V = np.ascontiguousarray(real_numbers(V, "positions"))
    if V.ndim != 2 or V.shape[1] != 3:
        raise CubicCraftError(f"positions must have the shape (n, 3), not {V.shape}")
    blocks = _blocks(F)
    if not sum(map(len, blocks)):
        raise CubicCraftError("the mesh has no faces; add faces first")
    if len(V) < 3:
        raise CubicCraftError(f"the mesh has only {len(V)} vertices; at least 3 are needed")
    least, most = min(int(x.min()) for x in blocks), max(int(x.max()) for x in blocks)
    if least < 0 or most >= len(V):
        raise CubicCraftError(
            f"triangles refer to vertices {least} to {most}, but there are only {len(V)}"
        )
    bad = np.flatnonzero(~np.isfinite(V).all(axis=1))
    if len(bad):
        raise CubicCraftError(
            f"{len(bad)} vertices have positions that are not finite"
            f" (the first is vertex {bad[0]}); move or delete them"
        )
    triangles = [_triangles(V, block) for block in blocks]
    F = triangles[0] if len(triangles) == 1 else np.concatenate(triangles)
    return V, np.ascontiguousarray(F, dtype=np.int32)


def faces_of_triangles(F: Faces) -> IntArray | None:
    """Return the face (m,) that each triangle of `check_mesh` is a piece of; None if all are whole.

    `F`: as there, and checked.
    """
    sizes = [np.full(len(block), block.shape[1] - 2) for block in _blocks(F)]
    pieces = np.concatenate(sizes)
    return None if (pieces == 1).all() else np.repeat(np.arange(len(pieces)), pieces)


def check_winding(F: IntArray, count: int) -> None:
    """Refuse triangles (m,3) between so many vertices of which many face the other way.

    Where triangles face away from each other, normals cancel out, and nothing becomes cubic.

    Raises CubicCraftError.
    """
    edges = Edges(F, count)
    number = edges.number.ravel()
    has_two = edges.uses == 2
    backward = np.bincount(number, edges.is_backward.ravel())
    share = float((has_two & (backward != 1)).sum()) / max(1, int(has_two.sum()))
    if share > MOST_REVERSED:
        raise CubicCraftError(
            f"at {share:.0%} of its edges, one of two triangles faces the other way; make their"
            " corners run one way around, as Recalculate Outside of Blender and fix_normals of"
            " trimesh do"
        )


def _blocks(F: Any) -> list[NDArray[Any]]:
    refuse_mask(F, "triangles")
    try:
        F = np.asarray(F)
    except ValueError:  # of different lengths
        F = np.array([*F, None], dtype=object)[:-1]  # which stays a row of rows
    if F.ndim != 1 or F.dtype.kind != "O":
        return [_block(F)] if F.size else []
    rows = [array_of(row, "faces") for row in F]
    if any(row.ndim != 1 for row in rows):
        raise CubicCraftError("faces must be rows of vertex numbers")
    sizes = np.array([len(row) for row in rows])
    return [
        _block(np.stack([rows[i] for i in np.flatnonzero(sizes == s)])) for s in np.unique(sizes)
    ]


def _block(F: NDArray[Any]) -> NDArray[Any]:
    if F.ndim != 2 or F.shape[1] < 3:
        raise CubicCraftError(f"triangles must have the shape (m, 3), not {F.shape}")
    if F.dtype.kind not in "iu":
        raise CubicCraftError(f"triangles must be integers, not {F.dtype}")
    return F


def _triangles(V: FloatArray, block: NDArray[Any]) -> NDArray[Any]:
    if block.shape[1] == 3:
        return block
    # Otherwise transposed triangles would pass as a few faces with very many corners.
    in_order = np.sort(block, axis=1)
    is_twice = in_order[:, 1:] == in_order[:, :-1]
    if is_twice.any():
        vertex = in_order[:, 1:][is_twice][0]
        raise CubicCraftError(
            f"a face with {block.shape[1]} corners has the vertex {vertex} twice; the faces must"
            " have the shape (m, corners)"
        )
    return triangulate(V, block)


def per_vertex(values: ArrayLike, name: str, n: int) -> FloatArray:
    """Return a scalar or an array (n,) as a finite, non-negative (n,) float64 array.

    Raises CubicCraftError: another shape or type, a negative or a non-finite value; `name` is used
    in the message.
    """
    values = real_numbers(values, name)
    if values.shape not in ((), (n,)):
        raise CubicCraftError(f"{name} must be one number or {n} of them, not {values.shape}")
    if not np.isfinite(values).all() or (values < 0).any():
        raise CubicCraftError(f"{name} must be finite and not negative")
    return np.ascontiguousarray(np.broadcast_to(values, (n,)))
