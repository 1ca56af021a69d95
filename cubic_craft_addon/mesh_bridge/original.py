# SPDX-License-Identifier: GPL-3.0-or-later
"""The original of a mesh that we have written to: kept, found again, or given up.

The original lies in point attributes of the mesh, so it is saved, copied and undone with it. It
is valid while the base of the mesh is what we wrote, bit for bit. Any edit since then makes the
edited shape the original.
"""

from typing import Any

import bpy
import numpy as np

from ...solver.errors import CubicCraftError
from .arrays import read_key, read_position
from .attributes import (
    ORIGINAL,
    ROTATION,
    add_attribute,
    our_attributes,
    read_attribute,
    remove_attribute,
)
from .cubic_key import find_cubic_key
from .fingerprint import fingerprint
from .note import read_note, write_note
from .rotations import matrices_from_quaternions
from .shapes import Shapes, carry, read_shapes

_POSITION = f"{ORIGINAL}.position"  # only where it is not equal to the base


def read_positions(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the shape that counts: the reference key's points, or without keys the positions.

    Returns
    -------
    (n,3) numpy float32 array, object space

    Raises
    ------
    CubicCraftError
        Edit Mode, or coordinates that are not finite.
    """
    return _finite(_base(mesh), mesh)


def original_positions(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the base as it was before we wrote to it, or as it is where it is not ours.

    Returns
    -------
    (n,3) numpy float32 array, object space

    Raises
    ------
    CubicCraftError
        Edit Mode, or coordinates that are not finite.
    """
    stored = stored_result(mesh)
    if stored is None:
        return read_positions(mesh)
    return _finite(_stored_base(mesh), mesh)


def has_original(mesh: bpy.types.Mesh | None) -> bool:
    """Tell whether the mesh holds a result of ours that `restore` can take back.

    It hashes the positions (2 ms per 100 000 vertices). False where there is no mesh, or one
    that cannot be read, as in Edit Mode.
    """
    if not isinstance(mesh, bpy.types.Mesh) or mesh.is_editmode:
        return False
    try:
        return stored_result(mesh) is not None or find_cubic_key(mesh) is not None
    except CubicCraftError:
        return False


def stored_result(mesh: bpy.types.Mesh) -> dict[str, Any] | None:
    """Return the part "mesh" of the note while it is valid: the base is still what we wrote."""
    stored = read_note(mesh).get("mesh")
    if stored is None or fingerprint(_base(mesh)) != stored["fingerprint"]:
        return None
    if read_attribute(mesh, ORIGINAL, 3) is None:
        return None  # the artist deleted it
    return stored


def original_shapes(mesh: bpy.types.Mesh) -> Shapes:
    """Read all shapes as they were before we wrote to them, our own shape key left out.

    Shape keys that are still as we wrote them get their original bits, also under another name.
    Those that the artist has added or edited since are carried back onto the original.
    """
    present = read_shapes(mesh, skip=find_cubic_key(mesh))
    stored = stored_result(mesh)
    if stored is None:
        return present
    base = _stored_base(mesh)
    quaternions = read_attribute(mesh, ROTATION, 4)
    if quaternions is None:
        back = np.broadcast_to(np.eye(3), (len(base), 3, 3))
    else:
        back = matrices_from_quaternions(quaternions).transpose(0, 2, 1)
    original = carry(present, base, back, _known_keys(mesh, stored, present))
    position = read_attribute(mesh, _POSITION, 3)
    if position is None or present.reference is None:
        return original
    return Shapes(position, original.keys, original.reference, original.relative)


def store_original(
    mesh: bpy.types.Mesh, original: Shapes, written: Shapes, quaternions: np.ndarray
) -> None:
    """Store the original in attributes of the mesh and write it down in the note.

    Parameters
    ----------
    mesh : a mesh without stored original (see `drop_stored`)
    original, written : the shapes before and after, of the same shape keys
    quaternions : (n,4) numpy float32 array, the rotations from the first to the second
    """
    add_attribute(mesh, ORIGINAL, original.base)
    add_attribute(mesh, ROTATION, quaternions)
    if original.position.tobytes() != original.base.tobytes():
        add_attribute(mesh, _POSITION, original.position)
    entries = []
    for number, name in enumerate(original.relative, start=1):
        # By number: the name of a key may be longer than that of an attribute.
        attribute = f"{ORIGINAL}.key{number}"
        add_attribute(mesh, attribute, original.keys[name])
        seen = fingerprint(written.keys[name])
        entries.append({"name": name, "fingerprint": seen, "attribute": attribute})
    result = {"fingerprint": fingerprint(written.base), "keys": entries}
    write_note(mesh, read_note(mesh) | {"mesh": result})


def drop_stored(mesh: bpy.types.Mesh) -> None:
    """Remove the stored original, valid or stale, and the run; the shapes stay as they are."""
    for name in our_attributes(mesh):
        remove_attribute(mesh, name)
    note = read_note(mesh)
    note.pop("mesh", None)
    note.pop("run", None)
    write_note(mesh, note)


def _known_keys(
    mesh: bpy.types.Mesh, stored: dict[str, Any], present: Shapes
) -> dict[str, np.ndarray]:
    """Find the original points of the shape keys that are still as we wrote them."""
    by_print = {entry["fingerprint"]: entry for entry in stored["keys"]}
    by_both = {(entry["name"], entry["fingerprint"]): entry for entry in stored["keys"]}
    known = {}
    for name in present.relative:
        seen = fingerprint(present.keys[name])
        entry = by_both.get((name, seen)) or by_print.get(seen)
        points = entry and read_attribute(mesh, entry["attribute"], 3)
        if points is not None:
            known[name] = points
    return known


def _base(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the shape that counts, whatever it holds."""
    position = read_position(mesh)
    return position if mesh.shape_keys is None else read_key(mesh, mesh.shape_keys.reference_key)


def _stored_base(mesh: bpy.types.Mesh) -> np.ndarray:
    """Read the base that `stored_result` has found to be there."""
    values = read_attribute(mesh, ORIGINAL, 3)
    assert values is not None
    return values


def _finite(positions: np.ndarray, mesh: bpy.types.Mesh) -> np.ndarray:
    """Pass positions on that are finite."""
    if not np.isfinite(positions).all():
        raise CubicCraftError(
            f"Mesh '{mesh.name}' has coordinates that are not finite: "
            "delete those vertices in Edit Mode first"
        )
    return positions
