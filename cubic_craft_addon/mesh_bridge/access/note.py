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
    ``base`` under it; and ``made_basis``.
``"live"``
    a preview is on: what ``"mesh"`` says, of the shape shown last. An empty ``fingerprint`` is of
    a shape that is just being written. Its ``outcome``, which may be anything, is for a file that
    is opened with the preview still on.
``"run"``
    besides ``"mesh"`` or ``"key"``: a `LastRun`.

A property of that name with any other value is not ours and is never changed.
"""

import hashlib
import json
from dataclasses import dataclass
from typing import Any, get_type_hints

import bpy
import numpy as np

from ....solver.console.run_words import end_words
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
_KEY_PART = {"name": str, "fingerprint": str, "base": str, "made_basis": bool}


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
    if "run" in note and not is_run(note["run"]):
        return False
    return "key" not in note or _fits(note["key"], _KEY_PART)


def is_run(part: Any) -> bool:
    """Return whether something from a file can be the "run" part."""
    return _fits(part, get_type_hints(LastRun))


def _fits(part: Any, types: dict[str, Any]) -> bool:
    return isinstance(part, dict) and all(isinstance(part.get(n), t) for n, t in types.items())


@dataclass(frozen=True)
class LastRun:
    """The run that made the cubic shape of a mesh.

    All displayed information about a result comes from here, not from an object: each object that
    shares the mesh has its own settings, but the shape was made with one set of them. The note
    follows the shape into copies, files and undo steps.
    """

    settings: dict
    """what matters to the shape, see `up_to_date.what_matters`"""
    vertices: int
    """of all objects that were solved together"""
    objects: int
    iterations: int
    energy: float
    converged: bool
    seconds: float
    """time that the artist has waited"""
    device: str
    matching: int | None = None
    """vertices of the mesh that have a mirror image, None without symmetry"""
    own_vertices: int = 0
    """of the mesh itself"""
    crossings: int | None = None
    """faces of all objects that cross others and did not at first, None if none were looked for"""
    pressed: int | None = None
    """how many of them are of parts that were let press into each other"""

    @property
    def status(self) -> str:
        """The summary in one line."""
        of_what = f" of {self.objects} objects" if self.objects > 1 else ""
        if self.matching is not None:
            of_what += f", {self.matching:,} of {self.own_vertices:,} match"
        end = "converged" if self.converged else "not converged, raise Max Iterations"
        return (
            f"{self.vertices:,} vertices{of_what}, {self.iterations} iterations, energy"
            f" {self.energy:.5f}, {end_words(end, self)}, {self.seconds:.2f} s on {self.device}"
        )


def note_run(mesh: bpy.types.Mesh, run: dict[str, Any] | None) -> None:
    """Note the run, a LastRun as a dict, with the result that has just been written, if any."""
    if run is not None:
        write_note(mesh, read_note(mesh) | {"run": run})


def last_run(obj: bpy.types.Object) -> LastRun | None:
    """Return the run that made the shape of the object's mesh, None if it has no result.

    It is cheap because it reads no positions, so it does not detect edits by the artist.
    """
    mesh = obj.data
    if not isinstance(mesh, bpy.types.Mesh):
        return None
    note = read_note(mesh)
    has_result = "mesh" in note or ("key" in note and mesh.shape_keys is not None)
    return LastRun(**note["run"]) if has_result and "run" in note else None
