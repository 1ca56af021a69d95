# SPDX-License-Identifier: GPL-3.0-or-later
"""The run that a mesh has its cubic shape from, as it is noted on the mesh itself.

All that is shown about a result comes from here, and not from an object: of several that share the
mesh each has settings of its own, but the shape was made with one set of them.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import bpy

from .. import mesh_bridge

if TYPE_CHECKING:
    from .pipeline import Solution


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


def run_of(solution: Solution, settings: dict[str, Any]) -> LastRun:
    """Return what there is to say about a solution that is going to be written."""
    result = solution.result
    return LastRun(
        settings=settings,
        vertices=solution.vertices,
        objects=solution.objects,
        iterations=int(result.iterations),
        energy=max(float(result.energy.total), 0.0),
        converged=bool(result.converged),
        seconds=float(solution.total_seconds),
        device=result.device,
        matching=None if solution.matching is None else int(solution.matching),
        own_vertices=int(solution.own_vertices),
    )


def last_run(obj: bpy.types.Object) -> LastRun | None:
    """Return the run that the object's mesh has its shape from, None if it has no result."""
    note = mesh_bridge.read_run(obj.data)
    return None if note is None else LastRun(**note)
