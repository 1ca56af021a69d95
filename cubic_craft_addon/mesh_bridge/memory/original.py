# SPDX-License-Identifier: GPL-3.0-or-later
"""The original of a mesh that we have written to: stored, recognized, or discarded.

The original is stored in point attributes of the mesh, together with our result, so it is saved,
copied, joined and undone with the mesh. If the base is our result, possibly transformed as a whole
or in parts, the original is transformed alike. If vertices have been moved by hand, the artist can
choose what to start from (`Start`).
"""

from typing import Literal

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.arrays import read_key, read_position
from ..access.attributes import (
    ORIGINAL,
    RESULT_KINDS,
    ROTATION,
    add_attribute,
    our_attributes,
    remove_attribute,
)
from ..access.note import read_note, write_note
from ..access.shapes import Shapes, read_shapes
from .cubic_key import find_cubic_key
from .recognition import Recognized
from .stored import Stored

Start = Literal["HERE", "ORIGINAL", "EDITS"]
"""what a mesh that was edited by hand since our result starts from: its shape; the original; or the
original, with the edits put back onto the result"""

STROKES = f"{ORIGINAL}.strokes"
"""what was moved by hand, see `strokes`; only where something was"""

RESULT = Stored(ORIGINAL, ROTATION, "mesh")


def read_positions(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the effective shape: the points of the reference key, or the positions without keys.

    Returns (n,3) float32, object space. Raises CubicCraftError: Edit Mode, or coordinates that are
    not finite.
    """
    return _finite(_base(mesh), mesh)


def original_positions(mesh: bpy.types.Mesh, start: Start = "HERE") -> np.ndarray:
    """Read the base as it was before we wrote to it, or as it is if it is not ours.

    Returns (n,3) float32, object space. Raises CubicCraftError: Edit Mode, or coordinates that are
    not finite.
    """
    present = _base(mesh)
    recognized = _start_of(mesh, start)
    if recognized is None or start == "EDITS":  # then edits go onto the result
        _finite(present, mesh)
    if recognized is None:
        return present
    return _finite(recognized.moved(RESULT.base(mesh), present), mesh)


def has_original(mesh: bpy.types.Mesh | None) -> bool:
    """Return whether the mesh holds a result of ours that `restore` can undo.

    It compares the positions. False where there is no mesh, or one that cannot be read, as in Edit
    Mode.
    """
    if not isinstance(mesh, bpy.types.Mesh) or mesh.is_editmode:
        return False
    try:
        return recognize_result(mesh) is not None or find_cubic_key(mesh) is not None
    except CubicCraftError:
        return False


def starts_here(mesh: bpy.types.Mesh, start: Start = "HERE") -> bool:
    """Return whether the next result starts from our result on the mesh.

    True if the mesh was edited by hand, also before that result. False if we have written nothing.
    """
    return has_stored(mesh) and _start_of(mesh, start) is None


def is_edited(mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh was edited by hand since we wrote it, and still has its original.

    As expensive as `has_original`.

    Raises CubicCraftError: the mesh is in Edit Mode, or has shape keys that do not fit.
    """
    recognized = recognize_result(mesh)
    return recognized is not None and recognized.is_edited


def is_lost(mesh: bpy.types.Mesh) -> bool:
    """Return whether there was an original that can no longer be determined.

    As expensive as `has_original`.

    Raises CubicCraftError: as `is_edited`.
    """
    return has_stored(mesh) and recognize_result(mesh) is None


def recognize_result(mesh: bpy.types.Mesh) -> Recognized | None:
    """Recognize the result on the mesh; None if it has no original."""
    return RESULT.recognize(mesh, _base(mesh)) if has_stored(mesh) else None


def has_stored(mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh holds an original, valid or stale. Cheap: it reads no positions."""
    return RESULT.is_on(mesh)


def has_strokes(mesh: bpy.types.Mesh) -> bool:
    """Return whether edits by hand are a part of the result. Cheap: it reads no positions."""
    return STROKES in our_attributes(mesh, (ORIGINAL,))


def original_shapes(mesh: bpy.types.Mesh, start: Start = "HERE") -> Shapes:
    """Read all shapes as they were before we wrote to them, without our own shape key.

    See `Stored.shapes_before`.
    """
    present = read_shapes(mesh, skip=find_cubic_key(mesh))
    recognized = _start_of(mesh, start)
    return present if recognized is None else RESULT.shapes_before(mesh, present, recognized)


def store_original(
    mesh: bpy.types.Mesh,
    original: Shapes,
    written: Shapes,
    quaternions: np.ndarray,
    strokes: np.ndarray | None = None,
) -> None:
    """Store the original on a mesh without one (see `drop_stored`), as `Stored.write` does.

    The strokes (n,3) are those in the result, see `strokes`.
    """
    RESULT.write(mesh, original, written, quaternions)
    if strokes is not None:
        add_attribute(mesh, STROKES, strokes)


def drop_stored(mesh: bpy.types.Mesh) -> None:
    """Remove the stored original, valid or stale, and the run; the shapes do not change.

    The first original stays, see `first_original`.
    """
    for name in our_attributes(mesh, RESULT_KINDS):
        remove_attribute(mesh, name)
    note = read_note(mesh)
    note.pop("mesh", None)
    note.pop("run", None)
    write_note(mesh, note)


def _start_of(mesh: bpy.types.Mesh, start: Start) -> Recognized | None:
    """Return the recognized result if its original is requested."""
    recognized = recognize_result(mesh)
    if recognized is None or start != "HERE":
        return recognized
    return None if recognized.is_edited or has_strokes(mesh) else recognized


def _base(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the effective shape without checks."""
    position = read_position(mesh)
    return position if mesh.shape_keys is None else read_key(mesh, mesh.shape_keys.reference_key)


def _finite(positions: np.ndarray, mesh: bpy.types.Mesh) -> np.ndarray:
    if not np.isfinite(positions).all():
        raise CubicCraftError(
            f'Mesh "{mesh.name}" has coordinates that are not finite: '
            "delete those vertices in Edit Mode first"
        )
    return positions
