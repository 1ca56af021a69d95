# SPDX-License-Identifier: GPL-3.0-or-later
"""Our note on a mesh: one custom property that describes what we wrote.

It is JSON text, because custom properties cannot hold lists of texts, with some of these parts:

``"mesh"``
    a result written to the mesh: ``fingerprint`` of the base as we wrote it, and per shape key
    other than the reference its ``name``, ``fingerprint`` and the ``attribute`` of its original.
``"first"``
    the first original, which *From Here* has replaced: what ``"mesh"`` says, of the original that
    took its place.
``"key"``
    a result written to a shape key: its ``name`` and ``fingerprint``; the fingerprint of the
    ``base`` under it, and the key's ``offsets`` from that; and ``made_basis``.
``"live"``
    a preview is on: what ``"mesh"`` says, of the shape shown last. An empty ``fingerprint`` is of
    a shape that is just being written. Its ``outcome``, which may be anything, is for a file that
    is opened with the preview still on.
``"run"``
    besides ``"mesh"`` or ``"key"``: the ``settings`` that the result was made with, and the outcome
    of the run, see `memory.last_run`.

A property of that name with any other value is not ours and is never changed.
"""

import hashlib
import json
from types import NoneType
from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError


def fingerprint(positions: np.ndarray) -> str:
    """Hash the bits of a shape.

    `positions`: (n,3) float32. Returns a str of 32 hexadecimal digits; equal only for the same
    number of vertices and the same bits.
    """
    bits = np.ascontiguousarray(positions, np.float32)
    return hashlib.blake2b(bits.data, digest_size=16).hexdigest()


def fingerprint_of_values(positions: np.ndarray) -> str:
    """Hash the values of a shape: `fingerprint`, but -0 is 0.

    Edit Mode turns -0 into 0 in many shape keys, which is not an edit by the artist.
    """
    return fingerprint(positions + np.float32(0))


NOTE = "cubic_craft_note"

_VERSION = 1

_MESH_PART = {"fingerprint": str, "keys": list}
_MESH_KEY = {"name": str, "fingerprint": str, "attribute": str}
_RUN_PART: dict[str, Any] = {
    "settings": dict,
    "vertices": int,
    "objects": int,
    "iterations": int,
    "energy": float,
    "converged": bool,
    "seconds": float,
    "device": str,
    "matching": (int, NoneType),
    "own_vertices": int,
    "crossings": (int, NoneType),
    "pressed": (int, NoneType),
}
_KEY_PART = {"name": str, "fingerprint": str, "base": str, "offsets": list, "made_basis": bool}


def read_note(mesh: bpy.types.Mesh) -> dict[str, Any]:
    """Read the note; empty if there is none, or if the property is not ours."""
    text = mesh.get(NOTE)
    if not isinstance(text, str):
        return {}
    try:
        note = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    if not isinstance(note, dict) or note.pop("version", None) != _VERSION:
        return {}
    return note if _is_ours(note) else {}


def write_note(mesh: bpy.types.Mesh, note: dict[str, Any]) -> None:
    """Write the note, or remove it if it is empty.

    Raises CubicCraftError: as `check_note`, if there is something to write.
    """
    if note:
        check_note(mesh)
        mesh[NOTE] = json.dumps({"version": _VERSION} | note)
    elif read_note(mesh):
        del mesh[NOTE]


def check_note(mesh: bpy.types.Mesh) -> None:
    """Check that the name of the note is free or ours.

    Raises CubicCraftError: a custom property of that name is not ours.
    """
    if NOTE in mesh and not read_note(mesh):
        raise CubicCraftError(
            f'Mesh "{mesh.name}" has a custom property "{NOTE}" that is not CubicCraft\'s own: '
            "rename or remove it first (Object Data > Custom Properties)"
        )


def _is_ours(note: dict[str, Any]) -> bool:
    """Return whether a note is valid, so that no other code must check it."""
    if not note or not note.keys() <= {"mesh", "first", "key", "live", "run"}:
        return False
    for part in (note[name] for name in ("mesh", "first", "live") if name in note):
        if not _fits(part, _MESH_PART) or not all(_fits(key, _MESH_KEY) for key in part["keys"]):
            return False
    if "run" in note and not _fits(note["run"], _RUN_PART):
        return False
    if "key" in note:
        part = note["key"]
        if not _fits(part, _KEY_PART):
            return False
        return all(type(value) in (int, float) for value in part["offsets"])
    return True


def is_run(part: Any) -> bool:
    """Return whether something from a file can be the "run" part."""
    return _fits(part, _RUN_PART)


def _fits(part: Any, types: dict[str, Any]) -> bool:
    return isinstance(part, dict) and all(isinstance(part.get(n), t) for n, t in types.items())
