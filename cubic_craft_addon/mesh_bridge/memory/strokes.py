# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes: what was moved by hand on a result, to be put back onto the next one.

A stroke is the offset of a vertex from the cubic shape, turned back by the rotation of the vertex
(as the offsets of shape keys are), so that it lies on the original and turns with the next result.
Those that are in a result are stored with it, and strokes made since are added to them.
"""

import bpy
import numpy as np

from ..access.attributes import read_attribute
from ..access.rounded_for_storage import check_shape
from .cubic_key import find_cubic_key, key_strokes
from .original import RESULT, STROKES, Start, has_strokes, read_positions, recognize_result
from .recognition import Recognized


def read_strokes(mesh: bpy.types.Mesh, start: Start) -> np.ndarray | None:
    """Read the strokes that belong onto the next result.

    `mesh`: a mesh without a preview. `start`: what the next result is made from; strokes are kept
    with "EDITS" only. Returns (n,3) float32 in object space, on the original as it is now; None if
    there are none.
    """
    if start != "EDITS":
        return None
    recognized = recognize_result(mesh)
    if recognized is None:
        return key_strokes(mesh) if find_cubic_key(mesh) is not None else None
    if not (recognized.is_edited or has_strokes(mesh)):
        return None
    strokes = _earlier(mesh, recognized)
    if recognized.is_edited:
        strokes += _since(mesh, recognized)
    if not strokes.any():
        return None
    with np.errstate(over="ignore"):  # infinities are refused when the result is written
        return strokes.astype(np.float32)


def offsets_by_hand(mesh: bpy.types.Mesh) -> np.ndarray | None:
    """Return how far vertices were moved by hand since the result, beside what moved them all.

    Returns (n,3) in object space, on the original; None if none were, or if the original is not
    known. Raises CubicCraftError: as `is_edited`, or coordinates that are not finite.
    """
    recognized = recognize_result(mesh)
    return _since(mesh, recognized) if recognized is not None and recognized.is_edited else None


def moved_as_a_whole(mesh: bpy.types.Mesh, points: np.ndarray) -> np.ndarray | None:
    """Move points (n,3) of object space as the mesh was since the result; None if it is none."""
    recognized = recognize_result(mesh)
    if recognized is None or not recognized.is_whole:
        return None
    return recognized.parts[0].map.moved(points)


def with_strokes(
    mesh: bpy.types.Mesh, points: np.ndarray, strokes: np.ndarray | None, matrices: np.ndarray
) -> np.ndarray:
    """Put strokes onto a result.

    `mesh`: the mesh of the result, named in messages. `points`: (n,3) float32, the cubic shape.
    `strokes`: (n,3) float32, or None for none. `matrices`: (n,3,3), the rotations of the vertices.
    Returns (n,3) float32; the bits of `points` where there are no strokes. Raises CubicCraftError:
    as `check_shape`.
    """
    if strokes is None:
        return points
    is_moved = strokes.any(axis=1)
    result = points.copy()
    with np.errstate(over="ignore"):  # infinities are refused
        turned = np.einsum("nij,nj->ni", matrices[is_moved], strokes[is_moved].astype(np.float64))
        result[is_moved] = points[is_moved] + turned
    check_shape(mesh, result, points.shape, "positions")
    return result


def _earlier(mesh: bpy.types.Mesh, recognized: Recognized) -> np.ndarray:
    """Return the strokes (n,3) float64 in the result, transformed with the mesh."""
    stored = read_attribute(mesh, STROKES, 3)
    strokes = np.zeros((len(mesh.vertices), 3))
    if stored is None:
        return strokes
    for part in recognized.parts:
        strokes[part.rows] = stored[part.rows].astype(np.float64) @ part.map.linear.T
    return strokes


def _since(mesh: bpy.types.Mesh, recognized: Recognized) -> np.ndarray:
    """Return the strokes (n,3) float64 made since the result."""
    present = read_positions(mesh)
    written = RESULT.written(mesh)
    assert written is not None  # or it would not have been recognized as edited
    offset = present.astype(np.float64) - recognized.moved(written, present)
    for part in recognized.parts:
        if not part.map.is_identity:  # whose rounding is no stroke
            is_still = part.map.agrees(written[part.rows], present[part.rows])
            offset[part.rows] = np.where(is_still[:, None], 0.0, offset[part.rows])
    return np.einsum("nij,nj->ni", RESULT.ways_back(mesh, recognized), offset)
