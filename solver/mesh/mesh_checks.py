# SPDX-License-Identifier: GPL-3.0-or-later
"""Refuse input that cannot be solved, before anything is computed."""

import numpy as np

from ..errors import CubicCraftError


def check_mesh(V, F):
    """Return the mesh as contiguous arrays, or raise an error that says what is wrong with it.

    Parameters
    ----------
    V : (n,3) array_like of float
        Vertex positions, any unit.
    F : (m,3) array_like of int
        Triangles, as indices into V.

    Returns
    -------
    V : (n,3) float64 array
    F : (m,3) int32 array

    Raises
    ------
    CubicCraftError
        Wrong shapes, no faces, fewer than 3 vertices, non-finite positions, indices out of range.
    """
    V = np.ascontiguousarray(V, dtype=np.float64)
    F = np.asarray(F)
    if V.ndim != 2 or V.shape[1] != 3:
        raise CubicCraftError(f"positions must have the shape (n, 3), not {V.shape}")
    if F.ndim != 2 or F.shape[1] != 3:
        raise CubicCraftError(f"triangles must have the shape (m, 3), not {F.shape}")
    if len(F) == 0:
        raise CubicCraftError("the mesh has no faces; add faces first")
    if len(V) < 3:
        raise CubicCraftError(f"the mesh has only {len(V)} vertices; at least 3 are needed")
    if not np.issubdtype(F.dtype, np.integer):
        raise CubicCraftError(f"triangles must be integers, not {F.dtype}")
    if F.min() < 0 or F.max() >= len(V):
        raise CubicCraftError(
            f"triangles refer to vertices {F.min()} to {F.max()}, but there are only {len(V)}"
        )
    bad = np.flatnonzero(~np.isfinite(V).all(axis=1))
    if len(bad):
        raise CubicCraftError(
            f"{len(bad)} vertices have positions that are not finite"
            f" (the first is vertex {bad[0]}); move or delete them"
        )
    return V, np.ascontiguousarray(F, dtype=np.int32)


def per_vertex(values, name, n):
    """Return a scalar or an array (n,) as a finite, non-negative (n,) float64 array.

    Raises
    ------
    CubicCraftError
        Another shape, a negative or a non-finite value; `name` is used in the message.
    """
    values = np.asarray(values, dtype=np.float64)
    if values.shape not in ((), (n,)):
        raise CubicCraftError(f"{name} must be one number or {n} of them, not {values.shape}")
    if not np.isfinite(values).all() or (values < 0).any():
        raise CubicCraftError(f"{name} must be finite and not negative")
    return np.ascontiguousarray(np.broadcast_to(values, (n,)))
