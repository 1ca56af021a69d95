# SPDX-License-Identifier: GPL-3.0-or-later
"""Change the shape of a result; the original and the note of its run stay what they are.

Restore then brings back the same original as before, and the next result starts from it.
"""

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.arrays import loose_vertices, read_key
from ..access.attributes import check_names
from ..access.checks import check_writable, mesh_of
from ..access.note import read_note
from ..access.rounded_for_storage import carry_finite, rounded_for_storage
from ..access.shapes import read_shapes, write_shapes
from ..memory.cubic_key import find_cubic_key
from ..memory.last_run import note_run
from ..memory.original import (
    RESULT,
    drop_stored,
    original_shapes,
    read_positions,
    recognize_result,
    store_original,
)
from ..memory.recognition import Recognized
from ..memory.strokes import read_strokes
from ..preview.end import end_preview
from .results import reshape_key
from .rollback import all_or_nothing


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

    Shape keys follow: they keep their offsets. Edits by hand become strokes in the result.

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
        reshape_key(obj, positions, run)
        return
    recognized = _recognized(mesh, obj.name)
    present, original = read_shapes(mesh), original_shapes(mesh, "ORIGINAL")
    quaternions = RESULT.rotations(mesh, recognized)
    strokes = read_strokes(mesh, "EDITS")
    positions = rounded_for_storage(mesh, positions, present.base, loose_vertices(mesh))
    unturned = np.broadcast_to(np.eye(3), (len(positions), 3, 3))
    written = carry_finite(mesh, present, positions, unturned)
    with all_or_nothing(mesh):
        drop_stored(mesh)
        store_original(mesh, original, written, quaternions, strokes)
        note_run(mesh, run)
        write_shapes(mesh, written)


def _recognized(mesh: bpy.types.Mesh, name: str) -> Recognized:
    """Recognize the result on a mesh, or refuse it."""
    found = recognize_result(mesh)
    if found is None:
        raise CubicCraftError(
            f'"{name}" has no result whose original is known: cubify it again, which starts from '
            "its current shape"
        )
    return found
