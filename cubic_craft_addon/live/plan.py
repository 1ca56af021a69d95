# SPDX-License-Identifier: GPL-3.0-or-later
"""What the objects of Live are to become, with its settings as they are now."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from collections.abc import Sequence

import bpy

from ...solver import CubicCraftError
from .. import mesh_bridge
from ..environment.modes import MODES
from ..read.member import assemblies
from ..run.tasks import Task, plan
from ..settings.overrides import SettingsOverrides
from . import properties
from .live_mesh import LiveMesh


class Plan:
    """The tasks of the objects, which are valid only within one event.

    `tasks`: by ``session_uid`` of the objects, that of the active one first. `groups`: those that
    are solved together, by their ``session_uid``. `problems`: what is wrong with the settings or
    the objects, as texts.
    """

    def __init__(self):
        self.problems: list[str] = []
        self.release()

    def release(self) -> None:
        """Forget all data of Blender."""
        self.tasks: dict[int, Task] = {}
        self.groups: dict[tuple[int, ...], list[Task]] = {}
        self.overrides = SettingsOverrides({})

    def renew(self, objects: list[bpy.types.Object]) -> None:
        """Determine the tasks of the objects, with the current settings."""
        self.tasks, self.groups = {}, {}
        try:
            self.overrides = properties.live_overrides(objects)
        except CubicCraftError as error:
            self.problems = [str(error)]
            return
        tasks, self.problems = plan(self.overrides, objects)
        for task in tasks:
            task.is_followed = task.settings.result == "NEW_OBJECT"
        self.problems += filter(None, map(mesh_bridge.cover_problem, objects))
        self.tasks = {task.uid: task for task in tasks}
        self.groups = {tuple(task.uid for task in group): group for group in assemblies(tasks)}

    @property
    def has_weights_at_hand(self) -> bool:
        """Whether weights can be read without a copy of the mesh, which would wake Live.

        Where they cannot, all is read anew when Blender reports a change of the mesh.
        """
        return not any(
            task.is_followed_as_seen or (task.is_followed and task.obj.mode not in MODES)
            for task in self.tasks.values()
        )

    @property
    def is_of_edit_mode(self) -> bool:
        """Whether reading an object has made Blender report its mesh as changed."""
        return any(task.obj.mode == "EDIT" for task in self.tasks.values())

    def pairs(self, meshes: Sequence[LiveMesh]) -> list[tuple[LiveMesh, Task]]:
        """Return each mesh that has a task, with the task."""
        tasks = [(mesh, self.tasks.get(mesh.object_uid)) for mesh in meshes]
        return [(mesh, task) for mesh, task in tasks if task is not None]

    def solved(self, meshes: Sequence[LiveMesh]) -> list[Task]:
        """Return the tasks of which there is something to write."""
        for mesh, task in self.pairs(meshes):
            task.solution = mesh.solution_so_far
        return [task for task in self.tasks.values() if task.solution is not None]
