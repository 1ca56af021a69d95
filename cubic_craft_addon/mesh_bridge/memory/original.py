# SPDX-License-Identifier: GPL-3.0-or-later
"""The original of a mesh that we have written to: stored, recognised, or discarded.

The original is stored in point attributes of the mesh, together with our result, so it is saved,
copied, joined and undone with the mesh. If the base is our result, possibly transformed as a whole
or in parts, the original is transformed alike. If vertices have been moved by hand, the artist can
choose to start from there or from the original (`Start`).
"""

from dataclasses import replace
from typing import Any, Literal

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.arrays import read_key, read_position
from ..access.attributes import (
    NORMALS,
    ORIGINAL,
    ROTATION,
    add_attribute,
    our_attributes,
    read_attribute,
    remove_attribute,
)
from ..access.fingerprint import fingerprint
from ..access.free_normals import domain_of_free_normals, turned
from ..access.note import read_note, write_note
from ..access.shapes import Shapes, read_shapes
from .carried_back import carry_back, ways_back
from .cubic_key import find_cubic_key
from .marks import make_marks
from .recognition import UNCHANGED, Recognised, recognise

Start = Literal["HERE", "ORIGINAL"]
"""what a mesh that was edited by hand since our result starts from: its shape or the original"""

_POSITION = f"{ORIGINAL}.position"  # only where it is not equal to the base
_WRITTEN = f"{ORIGINAL}.written"
_MARK = f"{ORIGINAL}.mark"


def read_positions(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the effective shape: the points of the reference key, or the positions without keys.

    Returns
    -------
    (n,3) numpy float32 array, object space

    Raises
    ------
    CubicCraftError
        Edit Mode, or coordinates that are not finite.
    """
    return _finite(_base(mesh), mesh)


def original_positions(mesh: bpy.types.Mesh, start: Start = "HERE") -> np.ndarray:
    """Read the base as it was before we wrote to it, or as it is if it is not ours.

    Returns
    -------
    (n,3) numpy float32 array, object space

    Raises
    ------
    CubicCraftError
        Edit Mode, or coordinates that are not finite.
    """
    present = _base(mesh)
    recognised = _start_of(mesh, start)
    if recognised is None:
        return _finite(present, mesh)
    return _finite(recognised.moved(_stored_base(mesh), present), mesh)


def has_original(mesh: bpy.types.Mesh | None) -> bool:
    """Return whether the mesh holds a result of ours that `restore` can undo.

    It compares the positions (2 ms per 100 000 vertices, more where they have changed). False where
    there is no mesh, or one that cannot be read, as in Edit Mode.
    """
    if not isinstance(mesh, bpy.types.Mesh) or mesh.is_editmode:
        return False
    try:
        return recognise_result(mesh) is not None or find_cubic_key(mesh) is not None
    except CubicCraftError:
        return False


def starts_here(mesh: bpy.types.Mesh, start: Start = "HERE") -> bool:
    """Return whether the next result starts from our result on the mesh.

    True if the mesh was edited by hand since. False if we have written nothing.
    """
    return has_stored(mesh) and _start_of(mesh, start) is None


def is_edited(mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh was edited by hand since we wrote it, and still has its original.

    As expensive as `has_original`.

    Raises
    ------
    CubicCraftError
        The mesh is in Edit Mode, or has shape keys that do not fit.
    """
    recognised = recognise_result(mesh)
    return recognised is not None and recognised.is_edited


def recognise_result(mesh: bpy.types.Mesh) -> Recognised | None:
    """Recognise the result on the mesh; None if it has no original."""
    if not has_stored(mesh):
        return None
    base = _base(mesh)
    stored = read_note(mesh).get("mesh")
    if stored is not None and fingerprint(base) == stored["fingerprint"]:
        return UNCHANGED
    marks, written = read_attribute(mesh, _MARK, 3), read_attribute(mesh, _WRITTEN, 3)
    if marks is None or written is None:
        return None  # deleted, or by a version that had none
    if stored is not None and _has_other_reference(mesh, stored):
        return None
    return recognise(marks, written, base)


def has_stored(mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh holds an original, valid or stale. Cheap: it reads no positions."""
    return ORIGINAL in our_attributes(mesh, (ORIGINAL,))


def original_shapes(mesh: bpy.types.Mesh, start: Start = "HERE") -> Shapes:
    """Read all shapes as they were before we wrote to them, without our own shape key.

    Shape keys that are still as we wrote them get their original bits, also under another name.
    Those that the artist has added or edited since are carried back onto the original.
    """
    present = read_shapes(mesh, skip=find_cubic_key(mesh))
    recognised = _start_of(mesh, start)
    if recognised is None:
        return present
    shapes = _shapes_before(mesh, present, recognised)
    return replace(shapes, normals=_normals_before(mesh, present, recognised))


def _shapes_before(mesh: bpy.types.Mesh, present: Shapes, recognised: Recognised) -> Shapes:
    """Return the positions and the shape keys as they were before a result."""
    stored_base = _stored_base(mesh)
    base = recognised.moved(stored_base, present.base)
    if present.reference is None:
        return Shapes(base, {}, None, {})
    entries = read_note(mesh).get("mesh", {}).get("keys", [])
    points = {e["name"]: read_attribute(mesh, e["attribute"], 3) for e in entries}
    stored = {name: values for name, values in points.items() if values is not None}
    keys = carry_back(
        present,
        recognised,
        base,
        read_attribute(mesh, ROTATION, 4),
        _known_keys(mesh, entries, present) if recognised.is_in_place else {},
        stored | {present.reference: stored_base},
    )
    position = read_attribute(mesh, _POSITION, 3) if recognised.is_whole else None
    position = base if position is None else recognised.moved(position, present.position)
    return Shapes(position, keys, present.reference, present.relative)


def _normals_before(
    mesh: bpy.types.Mesh, present: Shapes, recognised: Recognised
) -> np.ndarray | None:
    """Return the free normals as they were before a result; those that are new are turned back."""
    noted = read_note(mesh).get("mesh", {}).get("normals")
    if present.normals is None or noted is None:  # a version that did not turn them wrote it
        return present.normals
    stored = read_attribute(mesh, NORMALS, 3, domain_of_free_normals(mesh) or "")
    if stored is not None and noted == fingerprint(present.normals):
        return stored
    quaternions = read_attribute(mesh, ROTATION, 4)
    back = ways_back(recognised, quaternions, len(mesh.vertices))
    return turned(mesh, present.normals, back.with_mesh)


def store_original(
    mesh: bpy.types.Mesh, original: Shapes, written: Shapes, quaternions: np.ndarray
) -> None:
    """Store the original in attributes of the mesh and describe it in the note.

    Parameters
    ----------
    mesh : a mesh without stored original (see `drop_stored`)
    original, written : the shapes before and after, of the same shape keys
    quaternions : (n,4) numpy float32 array, the rotations from the first to the second
    """
    add_attribute(mesh, ORIGINAL, original.base)
    add_attribute(mesh, ROTATION, quaternions)
    add_attribute(mesh, _WRITTEN, written.base)
    add_attribute(mesh, _MARK, make_marks(original.base, written.base))
    if original.position.tobytes() != original.base.tobytes():
        add_attribute(mesh, _POSITION, original.position)
    entries = []
    for number, name in enumerate(original.relative, start=1):
        # By number: the name of a key may be longer than that of an attribute.
        attribute = f"{ORIGINAL}.key{number}"
        add_attribute(mesh, attribute, original.keys[name])
        seen = fingerprint(written.keys[name])
        entries.append({"name": name, "fingerprint": seen, "attribute": attribute})
    result = {"fingerprint": fingerprint(written.base), "keys": entries, "normals": ""}
    if original.normals is not None and written.normals is not None:
        add_attribute(mesh, NORMALS, original.normals, domain_of_free_normals(mesh))
        result["normals"] = fingerprint(written.normals)
    write_note(mesh, read_note(mesh) | {"mesh": result})


def drop_stored(mesh: bpy.types.Mesh) -> None:
    """Remove the stored original, valid or stale, and the run; the shapes do not change."""
    for name in our_attributes(mesh):
        remove_attribute(mesh, name)
    note = read_note(mesh)
    note.pop("mesh", None)
    note.pop("run", None)
    write_note(mesh, note)


def _start_of(mesh: bpy.types.Mesh, start: Start) -> Recognised | None:
    """Return the recognised result if its original is requested."""
    recognised = recognise_result(mesh)
    is_left = recognised is not None and recognised.is_edited and start == "HERE"
    return None if is_left else recognised


def _has_other_reference(mesh: bpy.types.Mesh, stored: dict[str, Any]) -> bool:
    """Return whether the artist has deleted Basis, so that another key has become the base."""
    if mesh.shape_keys is None:
        return False
    return mesh.shape_keys.reference_key.name in {entry["name"] for entry in stored["keys"]}


def _known_keys(
    mesh: bpy.types.Mesh, entries: list[dict[str, Any]], present: Shapes
) -> dict[str, np.ndarray]:
    """Find the original points of the shape keys that are still as we wrote them."""
    by_print = {entry["fingerprint"]: entry for entry in entries}
    by_both = {(entry["name"], entry["fingerprint"]): entry for entry in entries}
    known = {}
    for name in present.relative:
        seen = fingerprint(present.keys[name])
        entry = by_both.get((name, seen)) or by_print.get(seen)
        points = entry and read_attribute(mesh, entry["attribute"], 3)
        if points is not None:
            known[name] = points
    return known


def _base(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the effective shape without checks."""
    position = read_position(mesh)
    return position if mesh.shape_keys is None else read_key(mesh, mesh.shape_keys.reference_key)


def _stored_base(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the base as found by `recognise_result`."""
    values = read_attribute(mesh, ORIGINAL, 3)
    assert values is not None
    return values


def _finite(positions: np.ndarray, mesh: bpy.types.Mesh) -> np.ndarray:
    """Return the positions if they are finite."""
    if not np.isfinite(positions).all():
        raise CubicCraftError(
            f'Mesh "{mesh.name}" has coordinates that are not finite: '
            "delete those vertices in Edit Mode first"
        )
    return positions
