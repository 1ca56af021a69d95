# SPDX-License-Identifier: GPL-3.0-or-later
"""What Cubify has to solve: one task per mesh, or per new object."""

import numpy as np

from .. import solver
from ..cubic_craft_addon import cubify
from ..cubic_craft_addon.object_frame import stretch_and_orientation
from ..solver import CubicCraftError
from .run_settings import settings_for

_PROGRESS_STEPS = 100


class Task:
    """An object to be cubified with its settings; `solution` is there once it is solved."""

    def __init__(self, obj, settings):
        self.obj, self.mesh, self.settings = obj, obj.data, settings
        self.solution = None
        self._frame = stretch_and_orientation(obj, settings)

    def is_like(self, other):
        """Tell whether both have the same solution."""
        frames = zip(self._frame, other._frame, strict=True)
        return (
            self.mesh == other.mesh
            and self.settings == other.settings
            and all(np.allclose(a, b) for a, b in frames)
        )


def plan(operator, objects, frame):
    """Return the tasks, and the problems as texts.

    A mesh that several objects share is one task, as the first of them stands; only new objects
    can differ.
    """
    tasks, problems = [], []
    for obj in objects:
        try:
            task = Task(obj, settings_for(operator, obj, frame))
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


def solve_all(tasks, manager):
    """Return the tasks that could be solved, and the problems as texts."""
    solved, problems = [], []
    manager.progress_begin(0, _PROGRESS_STEPS * len(tasks))
    try:
        for number, task in enumerate(tasks):
            twin = next((other for other in solved if other.is_like(task)), None)
            try:
                task.solution = (
                    twin.solution if twin else _solve(task, manager, number * _PROGRESS_STEPS)
                )
            except CubicCraftError as error:
                problems.append(str(error))
            else:
                solved.append(task)
    finally:
        manager.progress_end()
    return solved, problems


def _solve(task, manager, offset):
    settings = task.settings
    progress = solver.Progress(settings.max_iterations, settings.tolerance)

    def show(stylization):
        manager.progress_update(offset + round(_PROGRESS_STEPS * progress.update(stylization)))
        return False

    return cubify.solve(cubify.prepare(task.obj, settings), settings, show)
