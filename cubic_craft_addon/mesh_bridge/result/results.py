# SPDX-License-Identifier: GPL-3.0-or-later
"""Write a result to the mesh itself or to a shape key.

Both always start from the original and replace an earlier result of ours; what was moved by hand on
that is put back if the artist wants it. Everything is computed and checked before the first write.
"""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

from ..access.arrays import loose_vertices, mark_moved
from ..access.attributes import check_names
from ..access.checks import check_relative_keys, check_writable, mesh_of
from ..access.rotations import matrices_from_quaternions
from ..access.rounded_for_storage import (
    carry_finite,
    matrices_for_storage,
    rotations_for_storage,
    rounded_for_storage,
)
from ..access.shapes import Shapes, write_shapes
from ..memory.cubic_key import find_cubic_key, remove_cubic_key, write_cubic_key
from ..memory.first_original import first_kept
from ..memory.last_run import note_run
from ..memory.original import (
    Start,
    drop_stored,
    original_positions,
    original_shapes,
    store_original,
)
from ..memory.strokes import read_strokes, with_strokes
from ..preview.end import end_preview
from .rollback import all_or_nothing


def write_mesh(
    mesh: bpy.types.Mesh,
    positions: np.ndarray,
    rotations: np.ndarray,
    run: dict[str, Any] | None = None,
    start: Start = "HERE",
    finish: Callable[[], None] = lambda: None,
) -> None:
    """Write a result to the mesh: the base moves and the shape keys follow.

    Parameters
    ----------
    mesh : a mesh in Object Mode
    positions : (n,3) numpy array, object space; ignored for vertices in no face
    rotations : (n,3,3) numpy array, the local rotation of each vertex
    run : the note of the run (see `note`)
    start : what the result was made from if the mesh was edited by hand since the last one
    finish : called once the shape is written; if it raises, the mesh is unchanged

    Raises
    ------
    CubicCraftError
        Wrong number of vertices, values that are not finite, a mesh that cannot be written, or
        a name conflict with our note or attributes. The mesh is then unchanged.
    """
    check_writable(mesh, mesh.name)
    check_names(mesh)
    end_preview(mesh)
    cubic_key = find_cubic_key(mesh)
    original = original_shapes(mesh, start)
    loose = loose_vertices(mesh)
    strokes = read_strokes(mesh, start)
    keep_first = first_kept(mesh, start, original)
    positions = rounded_for_storage(mesh, positions, original.base, loose)
    quaternions = rotations_for_storage(mesh, rotations, loose)
    matrices = matrices_from_quaternions(quaternions)
    positions = with_strokes(mesh, positions, strokes, matrices)
    written = carry_finite(mesh, original, positions, matrices)
    with all_or_nothing(mesh):
        drop_stored(mesh)
        keep_first()
        store_original(mesh, original, written, quaternions, strokes)
        note_run(mesh, run)
        write_shapes(mesh, written)
        finish()
        remove_cubic_key(mesh, cubic_key)


def write_shape_key(
    obj: bpy.types.Object,
    positions: np.ndarray,
    rotations: np.ndarray | None = None,
    run: dict[str, Any] | None = None,
    start: Start = "HERE",
    finish: Callable[[], None] = lambda: None,
) -> None:
    """Write a result to the shape key "Cubic"; everything else has its original shape.

    `obj`: an object with a mesh, in Object Mode. `positions`: (n,3), object space; ignored for
    vertices in no face. `rotations`: (n,3,3), by which what was moved by hand turns; None if
    nothing turns. `run`: the note of the run (see `note`). `start`: what the result was made from
    if the mesh was edited by hand since the last one. `finish`: as of `write_mesh`. Raises
    CubicCraftError: wrong number of vertices, values that are not finite, absolute shape keys, or a
    mesh that cannot be written. The mesh is then unchanged.
    """
    mesh = mesh_of(obj)
    _check_for_key(obj, mesh)
    original = original_shapes(mesh, start)
    loose = loose_vertices(mesh)
    strokes = read_strokes(mesh, start)
    positions = rounded_for_storage(mesh, positions, original.base, loose)
    positions = with_strokes(mesh, positions, strokes, matrices_for_storage(mesh, rotations, loose))
    keep_first = first_kept(mesh, start, original)
    _write_key(obj, original, positions, strokes, run, keep_first, finish)


def reshape_key(
    obj: bpy.types.Object, positions: np.ndarray, run: dict[str, Any] | None = None
) -> None:
    """Change the shape of a result in the shape key "Cubic", strokes included.

    Parameters and errors are those of `write_shape_key`.
    """
    mesh = mesh_of(obj)
    _check_for_key(obj, mesh)
    original = original_shapes(mesh)
    positions = rounded_for_storage(mesh, positions, original.base, loose_vertices(mesh))
    _write_key(obj, original, positions, read_strokes(mesh, "EDITS"), run)


def positions_with_strokes(
    mesh: bpy.types.Mesh, positions: np.ndarray, rotations: np.ndarray, start: Start
) -> np.ndarray:
    """Return the base that `write_mesh` would write, (n,3), with what was moved by hand.

    Parameters and errors are those of `write_mesh`.
    """
    strokes = read_strokes(mesh, start)
    if strokes is None:
        return positions
    loose = loose_vertices(mesh)
    points = rounded_for_storage(mesh, positions, original_positions(mesh, start), loose)
    return with_strokes(mesh, points, strokes, matrices_for_storage(mesh, rotations, loose))


def _check_for_key(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> None:
    """End a preview on a mesh that a shape key can be written to; refuse others."""
    check_writable(mesh, obj.name)
    check_relative_keys(obj)
    end_preview(mesh)


def _write_key(
    obj: bpy.types.Object,
    original: Shapes,
    positions: np.ndarray,
    strokes: np.ndarray | None,
    run: dict[str, Any] | None,
    keep_first: Callable[[], None] = lambda: None,
    finish: Callable[[], None] = lambda: None,
) -> None:
    mesh = mesh_of(obj)
    cubic_key = find_cubic_key(mesh)
    with all_or_nothing(mesh):
        write_shapes(mesh, original)
        drop_stored(mesh)
        keep_first()
        write_cubic_key(obj, positions, cubic_key, strokes)
        note_run(mesh, run)
        mark_moved(mesh)
        finish()
