# SPDX-License-Identifier: GPL-3.0-or-later
"""The run that a mesh has its cubic shape from, as it is noted on the mesh itself.

All that is shown about a result comes from here, and not from an object: of several that share the
mesh each has settings of its own, but the shape was made with one set of them. So it goes with the
shape into copies, files and undo steps.
"""

from dataclasses import dataclass
from typing import Any

import bpy

from ..access.note import read_note, write_note


@dataclass(frozen=True)
class LastRun:
    """How a mesh was made cubic."""

    settings: dict[str, Any]
    """what matters to the shape, see `up_to_date.what_matters`"""
    vertices: int
    """of all objects that were solved at once"""
    objects: int
    iterations: int
    energy: float
    converged: bool
    seconds: float
    """that the artist has waited for it"""
    device: str
    matching: int | None = None
    """vertices of the mesh that have a mirror image, None without symmetry"""
    own_vertices: int = 0
    """of the mesh itself"""

    @property
    def status(self) -> str:
        """All of it in one line."""
        of_what = f" of {self.objects} objects" if self.objects > 1 else ""
        if self.matching is not None:
            of_what += f", {self.matching:,} of {self.own_vertices:,} match"
        end = "converged" if self.converged else "not converged, raise Max Iterations"
        return (
            f"{self.vertices:,} vertices{of_what}, {self.iterations} iterations, energy"
            f" {self.energy:.5f}, {end}, {self.seconds:.2f} s on {self.device}"
        )


def note_run(mesh: bpy.types.Mesh, run: dict[str, Any] | None) -> None:
    """Note the run, a LastRun as a dict, beside the result that has just been written, if any."""
    if run is not None:
        write_note(mesh, read_note(mesh) | {"run": run})


def last_run(obj: bpy.types.Object) -> LastRun | None:
    """Return the run that the object's mesh has its shape from, None if it has no result.

    Cheap: it reads no positions, and so does not see that the artist has edited them since.
    """
    mesh = obj.data
    if not isinstance(mesh, bpy.types.Mesh):
        return None
    note = read_note(mesh)
    has_result = "mesh" in note or ("key" in note and mesh.shape_keys is not None)
    return LastRun(**note["run"]) if has_result and "run" in note else None
