# SPDX-License-Identifier: GPL-3.0-or-later
"""The run that made the cubic shape of a mesh, as noted on the mesh itself.

All displayed information about a result comes from here, not from an object: each object that
shares the mesh has its own settings, but the shape was made with one set of them. The note follows
the shape into copies, files and undo steps.
"""

from dataclasses import dataclass
from typing import Any

import bpy

from ....solver.console.run_words import end_words
from ..access.note import read_note, write_note


@dataclass(frozen=True)
class LastRun:
    """How a mesh was made cubic."""

    settings: dict[str, Any]
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
