# SPDX-License-Identifier: GPL-3.0-or-later
"""What is noted of the run that a mesh has its cubic shape from.

It lies on the mesh, not on an object: so it goes with the shape into copies, files and undo steps,
and all objects that share the mesh say the same of it.
"""

from typing import Any

import bpy

from .note import read_note, write_note


def note_run(mesh: bpy.types.Mesh, run: dict[str, Any] | None) -> None:
    """Note the run beside the result that has just been written; None leaves it out."""
    if run is not None:
        write_note(mesh, read_note(mesh) | {"run": run})


def read_run(mesh: bpy.types.ID | None) -> dict[str, Any] | None:
    """Return what is noted of the run; None where the mesh has no result, or is no mesh.

    Cheap: it reads no positions, and so does not see that the artist has edited them since.
    """
    if not isinstance(mesh, bpy.types.Mesh):
        return None
    note = read_note(mesh)
    if "mesh" in note or ("key" in note and mesh.shape_keys is not None):
        return note.get("run")
    return None
