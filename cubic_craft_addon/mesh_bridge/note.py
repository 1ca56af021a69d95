# SPDX-License-Identifier: GPL-3.0-or-later
"""The note of ours on a mesh: one custom property that says what we wrote.

It is JSON text, because custom properties cannot hold lists of texts, with one of two parts:

``"mesh"``
    a result written to the mesh: ``fingerprint`` of the base as we wrote it, and per shape key
    other than the reference its ``name``, ``fingerprint`` and the ``attribute`` of its original.
``"key"``
    a result written to a shape key: its ``name`` and ``fingerprint``, and ``made_basis``.
"""

import json
from typing import Any

import bpy

NOTE = "cubic_craft"

_VERSION = 1


def read_note(mesh: bpy.types.Mesh) -> dict[str, Any]:
    """Read the note; empty where there is none, or something of that name that is not ours."""
    text = mesh.get(NOTE)
    if not isinstance(text, str):
        return {}
    try:
        note = json.loads(text)
    except json.JSONDecodeError:
        return {}
    if not isinstance(note, dict) or note.pop("version", None) != _VERSION:
        return {}
    return note


def write_note(mesh: bpy.types.Mesh, note: dict[str, Any]) -> None:
    """Write the note, or take it away where nothing is left to say."""
    if note:
        mesh[NOTE] = json.dumps({"version": _VERSION} | note)
    elif read_note(mesh):
        del mesh[NOTE]
