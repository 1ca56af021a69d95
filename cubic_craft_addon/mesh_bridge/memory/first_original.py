# SPDX-License-Identifier: GPL-3.0-or-later
"""The first original, which stays on the mesh when *From Here* makes an edited shape the original.

It is stored as the original of that edited shape. So it is reached in two steps: from the result
to its original, and from there to the first. Only Apply and *Restore First* remove it.
"""

from collections.abc import Callable

import bpy
import numpy as np

from ..access.attributes import FIRST, our_attributes, remove_attribute
from ..access.note import read_note, write_note
from ..access.rounded_for_storage import matrices_from_quaternions, quaternions_from_matrices
from ..access.shapes import Shapes
from .original import RESULT, Start, is_lost, original_shapes, recognize_result, starts_here
from .stored import Stored

_FIRST = Stored(FIRST, f"{FIRST}.rotation", "first")


def has_first(mesh: bpy.types.Mesh | None) -> bool:
    """Return whether the mesh holds a first original, valid or stale. Cheap, as `has_stored`."""
    return isinstance(mesh, bpy.types.Mesh) and _FIRST.is_on(mesh)


def first_shapes(mesh: bpy.types.Mesh) -> Shapes | None:
    """Read all shapes of the first original, without our own shape key; None if it is unknown."""
    if not has_first(mesh) or is_lost(mesh):
        return None
    later = original_shapes(mesh, "ORIGINAL")
    recognized = _FIRST.recognize(mesh, later.base)
    return None if recognized is None else _FIRST.shapes_before(mesh, later, recognized)


def first_kept(mesh: bpy.types.Mesh, start: Start, original: Shapes) -> Callable[[], None]:
    """Return what keeps the first original when a result is written; call it after `drop_stored`.

    Everything is read at once, nothing is changed.

    `mesh`: as it is before the result is written. `start`, `original`: what that is made from.
    """
    if not starts_here(mesh, start):
        return lambda: None  # it is still that of the same original
    recognized = recognize_result(mesh)
    if recognized is None:
        return lambda: drop_first(mesh)
    first = original_shapes(mesh, "ORIGINAL")
    quaternions = RESULT.rotations(mesh, recognized)
    earlier = _FIRST.recognize(mesh, first.base)
    if earlier is not None:
        turns = _FIRST.rotations(mesh, earlier)
        first = _FIRST.shapes_before(mesh, first, earlier)
        quaternions = _product(quaternions, turns)

    def store() -> None:
        drop_first(mesh)
        _FIRST.write(mesh, first, original, quaternions)

    return store


def drop_first(mesh: bpy.types.Mesh) -> None:
    """Remove the first original, valid or stale."""
    for name in our_attributes(mesh, (FIRST,)):
        remove_attribute(mesh, name)
    note = read_note(mesh)
    if note.pop("first", None) is not None:
        write_note(mesh, note)


def _product(later: np.ndarray, earlier: np.ndarray) -> np.ndarray:
    """Return the rotations (n,4) that one after the other makes."""
    turned = matrices_from_quaternions(later) @ matrices_from_quaternions(earlier)
    return quaternions_from_matrices(turned)
