# SPDX-License-Identifier: GPL-3.0-or-later
"""What there is to solve: one task per mesh, or per new object. And how all results are written."""

import logging
from dataclasses import replace
from itertools import accumulate

import bpy
import numpy as np

from ..solver import CubicCraftError
from . import cubify, mesh_bridge
from .choice import Choice
from .failures import UNFORESEEN, in_words
from .handles.baked_pose import remember_pose
from .object_frame import stretch_and_orientation
from .object_properties import object_properties
from .settings_rollback import settings_kept
from .taichi_news import taichi_news

_log = logging.getLogger(__name__)


class Task:
    """An object to be cubified with its settings; `solution` is there once it is solved."""

    def __init__(self, obj: bpy.types.Object, choice: Choice):
        self.obj, self.mesh = obj, mesh_bridge.mesh_of(obj)
        self.settings = choice.settings_for(obj)
        self.solution: cubify.Solution | None = None
        self._frame = stretch_and_orientation(obj, self.settings)

    @property
    def key(self):
        """All that decides the solution beside the mesh; free of references to Blender's data."""
        return replace(self.settings, frame=None), *(part.tobytes() for part in self._frame)

    def is_like(self, other: "Task") -> bool:
        """Tell whether both have the same solution."""
        frames = zip(self._frame, other._frame, strict=True)
        return (
            self.mesh == other.mesh
            and self.settings == other.settings
            and all(np.allclose(a, b) for a, b in frames)
        )


def plan(choice: Choice, objects: list[bpy.types.Object]) -> tuple[list[Task], list[str]]:
    """Return the tasks, and the problems as texts.

    A mesh that several objects share is one task, as the first of them stands; only new objects
    can differ.
    """
    tasks, problems = [], []
    for obj in objects:
        try:
            task = Task(obj, choice)
        except CubicCraftError as error:
            problems.append(str(error))
            continue
        twin = next((other for other in tasks if other.mesh == task.mesh), None)
        if twin is None or task.settings.result == "NEW_OBJECT":
            tasks.append(task)
        elif not twin.is_like(task):
            problems.append(
                f'"{obj.name}" shares its mesh with "{twin.obj.name}" and has taken its shape;'
                " make it single-user for a shape of its own"
            )
    return tasks, problems


def write_all(choice: Choice, tasks: list[Task]) -> tuple[str, list[str]]:
    """Write the solutions of all tasks.

    Returns
    -------
    summary : str
        Empty if nothing was written.
    problems : list of str
        What was written before a failure stays and needs its undo step. Also that Taichi does not
        work, once.
    """
    # All texts come before the first write: what follows a write must not fail.
    solutions = [task.solution for task in tasks if task.solution is not None]
    statuses = [_status(solution) for solution in solutions]
    ends = list(accumulate(solution.total_seconds for solution in solutions))
    written, problems = 0, taichi_news() if tasks else []
    try:
        for task, status in zip(tasks, statuses, strict=True):
            _write(choice, task, status)
            written += 1
    except UNFORESEEN as error:
        _log.exception("Writing a result failed")  # this object has been put back
        reason = in_words(error)
        problems.append(f"Writing failed ({reason}); what was not written yet is unchanged")
    if written == 1:
        return f"Cubified: {statuses[0]}", problems
    if written:
        return f"Cubified {written} meshes in {ends[written - 1]:.2f} s", problems
    return "", problems


def _write(choice, task, status):
    """Write one solution, or nothing at all."""

    def remember(target):
        # A shape key poses nothing: its basis is still the original.
        is_posed = task.settings.result != "SHAPE_KEY" and choice.uses_own_handles(task.obj)
        remember_pose(target, is_posed=is_posed)
        choice.remember_on(target, task.settings)
        object_properties(target).status = status

    with settings_kept([task.mesh]):
        cubify.write(task.obj, task.solution, task.settings.result, remember)


def _status(solution):
    r = solution.result
    end = "converged" if r.converged else "not converged, raise Max Iterations"
    return (
        f"{len(solution.positions):,} vertices, {r.iterations} iterations, energy"
        f" {max(r.energy.total, 0.0):.5f}, {end}, {solution.total_seconds:.2f} s on {r.device}"
    )
