# SPDX-License-Identifier: GPL-3.0-or-later
"""Write a result to the mesh itself or to a shape key.

Both always start from the original and replace an earlier result of ours; what was moved by hand on
that is put back if the artist wants it. Everything is computed and checked before the first write.
"""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.arrays import loose_vertices, mark_moved, read_key
from ..access.attributes import check_names
from ..access.checks import check_relative_keys, check_writable, mesh_of
from ..access.note import fingerprint_of_values, is_run, note_run, read_note
from ..access.rounded_for_storage import (
    carry_finite,
    matrices_for_storage,
    matrices_from_quaternions,
    rotations_for_storage,
    rounded_for_storage,
)
from ..access.shapes import Shapes, read_shapes, write_shapes
from ..memory.cubic_key import find_cubic_key, remove_cubic_key, write_cubic_key
from ..memory.first_original import first_kept
from ..memory.original import (
    RESULT,
    Start,
    drop_stored,
    original_positions,
    original_shapes,
    read_positions,
    recognize_result,
    store_original,
)
from ..memory.recognition import Recognized
from ..memory.strokes import read_strokes, with_strokes
from ..preview.store import end_preview
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

    `mesh`: a mesh in Object Mode. `positions`: (n,3), object space; ignored for vertices in no
    face. `rotations`: (n,3,3), the local rotation of each vertex. `run`: the note of the run (see
    `note`). `start`: what the result was made from if the mesh was edited by hand since the last
    one. `finish`: called once the shape is written; if it raises, the mesh is unchanged. Raises
    CubicCraftError: wrong number of vertices, values that are not finite, a mesh that cannot be
    written, or a name conflict with our note or attributes. The mesh is then unchanged.
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
        _replace(mesh, original, written, quaternions, strokes, run, keep_first)
        finish()
        remove_cubic_key(mesh, cubic_key)


def _replace(
    mesh: bpy.types.Mesh,
    original: Shapes,
    written: Shapes,
    quaternions: np.ndarray,
    strokes: np.ndarray | None,
    run: dict[str, Any] | None,
    keep_first: Callable[[], None] = lambda: None,
) -> None:
    """Write shapes, with all that is kept of them, in place of an earlier result."""
    drop_stored(mesh)
    keep_first()
    store_original(mesh, original, written, quaternions, strokes)
    note_run(mesh, run)
    write_shapes(mesh, written)


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
    check_writable(mesh, obj.name)
    check_relative_keys(obj)
    end_preview(mesh)
    original = original_shapes(mesh, start)
    loose = loose_vertices(mesh)
    strokes = read_strokes(mesh, start)
    positions = rounded_for_storage(mesh, positions, original.base, loose)
    positions = with_strokes(mesh, positions, strokes, matrices_for_storage(mesh, rotations, loose))
    keep_first = first_kept(mesh, start, original)
    _write_key(obj, original, positions, strokes, run, keep_first, finish)


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


def result_positions(obj: bpy.types.Object) -> np.ndarray:
    """Read the present shape of a result: of the shape key "Cubic", or of the mesh.

    `obj`: an object with a mesh that shows no preview. Returns (n,3) float32, object space. Raises
    CubicCraftError: there is no result, or none whose original is known; Edit Mode, or coordinates
    that are not finite.
    """
    mesh = mesh_of(obj)
    key = find_cubic_key(mesh)
    if key is not None:
        return read_key(mesh, key)
    positions = read_positions(mesh)
    _recognized(mesh, obj.name)
    return positions


def write_reshaped(obj: bpy.types.Object, positions: np.ndarray) -> None:
    """Write a changed shape of a result to where `result_positions` reads it.

    Shape keys follow: they keep their offsets. Edits by hand become strokes in the result. The
    original and the note of the run stay what they are.

    `obj`: an object with a mesh that has a result, in Object Mode. `positions`: (n,3), object
    space; ignored for vertices in no face. Raises CubicCraftError: as `result_positions`; wrong
    number of vertices, values that are not finite, or a mesh that cannot be written. The mesh is
    then unchanged.
    """
    mesh = mesh_of(obj)
    check_writable(mesh, obj.name)
    check_names(mesh)
    end_preview(mesh)
    run = read_note(mesh).get("run")
    if find_cubic_key(mesh) is not None:
        check_relative_keys(obj)
        original = original_shapes(mesh)
        positions = rounded_for_storage(mesh, positions, original.base, loose_vertices(mesh))
        _write_key(obj, original, positions, read_strokes(mesh, "EDITS"), run)
        return
    recognized = _recognized(mesh, obj.name)
    present, original = read_shapes(mesh), original_shapes(mesh, "ORIGINAL")
    quaternions = RESULT.rotations(mesh, recognized)
    strokes = read_strokes(mesh, "EDITS")
    positions = rounded_for_storage(mesh, positions, present.base, loose_vertices(mesh))
    unturned = np.broadcast_to(np.eye(3), (len(positions), 3, 3))
    written = carry_finite(mesh, present, positions, unturned)
    with all_or_nothing(mesh):
        _replace(mesh, original, written, quaternions, strokes, run)


def _recognized(mesh: bpy.types.Mesh, name: str) -> Recognized:
    found = recognize_result(mesh)
    if found is None:
        raise CubicCraftError(
            f'"{name}" has no result whose original is known: cubify it again, which starts from '
            "its current shape"
        )
    return found


def noted_outcome(mesh: bpy.types.Mesh) -> Any:
    """Return the outcome that `Preview.show` has noted on the mesh, None if there is none."""
    return read_note(mesh).get("live", {}).get("outcome")


def keep_preview(mesh: bpy.types.Mesh, run: dict[str, Any], start: Start) -> None:
    """Write the shape that the preview shows as a result.

    `mesh`: with a preview on it, in Object Mode. `run`: the note of the run (see `note`). `start`:
    what the run has started from if the mesh was edited by hand since the last result. Raises
    CubicCraftError: the shape is not that of the preview, the run is not one, or a mesh that cannot
    be written. The mesh is then unchanged.
    """
    check_writable(mesh, mesh.name)
    check_names(mesh)
    shown = read_shapes(mesh)
    part = read_note(mesh).get("live")
    if part is None or part["fingerprint"] != fingerprint_of_values(shown.base):
        raise CubicCraftError(f'Mesh "{mesh.name}" does not have the shape of its preview')
    if not is_run(run):
        raise CubicCraftError(f'Mesh "{mesh.name}" has a preview of an unknown run')
    unturned = np.tile(np.array((1, 0, 0, 0), np.float32), (len(mesh.vertices), 1))
    with all_or_nothing(mesh):
        end_preview(mesh)
        cubic_key = find_cubic_key(mesh)
        original = original_shapes(mesh, start)
        strokes = read_strokes(mesh, start)
        keep_first = first_kept(mesh, start, original)
        _replace(mesh, original, shown, unturned, strokes, run, keep_first)
        remove_cubic_key(mesh, cubic_key)
