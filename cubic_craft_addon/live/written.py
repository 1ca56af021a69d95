# SPDX-License-Identifier: GPL-3.0-or-later
"""What Live writes: at its end, in the mode that allows it, or for as long as a file is saved."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import contextlib
import logging
from collections.abc import Sequence

import bpy

from .. import hidden_source, mesh_bridge
from ..run.failures import UNEXPECTED
from ..run.tasks import Task, write_all, write_task
from ..settings.overrides import SettingsOverrides
from ..settings.rollback import settings_untouched
from . import elsewhere
from .live_mesh import LiveMesh
from .plan import Plan

_log = logging.getLogger(__name__)


def write_for_file(
    overrides: SettingsOverrides, tasks: Sequence[Task]
) -> contextlib.AbstractContextManager:
    """Write the solutions of tasks for as long as a file is being saved.

    A mesh whose shape key "Cubic" its result would replace is left as it is: Blender cannot bring
    a removed key back.

    Returns what brings everything back once it is closed; if writing fails, this has been done.
    """
    kept = [task for task in tasks if not _loses_key(task)]
    with contextlib.ExitStack() as stack:
        meshes = list(dict.fromkeys(task.mesh for task in kept))
        for mesh in dict.fromkeys(task.mesh for task in kept if not task.is_followed):
            stack.enter_context(mesh_bridge.mesh_untouched(mesh))
        stack.enter_context(settings_untouched(meshes))
        for task in kept:
            put_back = hidden_source.as_it_was(task.obj)
            write_task(overrides, task, task.run)
            stack.callback(put_back)
            if task.written is not None and task.written != task.obj:
                stack.callback(mesh_bridge.remove_copy, task.written)
        return stack.pop_all()


def _loses_key(task):
    return task.settings.result == "MESH" and mesh_bridge.find_cubic_key(task.mesh) is not None


class Written:
    """What has been written.

    `summary`: as from `tasks.write_all`; empty if nothing was written. `problems`: why something
    could not be written, as texts. `has_pushed_undo`: whether it has its undo step already.
    """

    def __init__(self):
        self.summary, self.has_pushed_undo = "", False
        self.problems: list[str] = []
        self._mode_left = ""
        self._in_file: contextlib.AbstractContextManager = contextlib.nullcontext()

    def leave_mode(self, objects: Sequence[bpy.types.Object]) -> None:
        """Leave a mode that forbids writing."""
        self._mode_left = elsewhere.leave_mode(list(objects))

    def back_to_mode(self) -> None:
        """Go back to the mode that was left."""
        if self._mode_left:
            elsewhere.back_to_mode(self._mode_left, has_written=bool(self.summary))
            self.has_pushed_undo = bool(self.summary)

    def push_undo(self) -> None:
        """Push an undo step for what was written, if anything was."""
        if self.summary:
            # once Blender is done with what it does now
            bpy.app.timers.register(elsewhere.push_undo, first_interval=0.0)

    def write(self, plan: Plan, meshes: Sequence[LiveMesh], problems: Sequence[str]) -> None:
        """Write all that is solved; `problems` are those of what is not."""
        with _selection_untouched():
            self.summary, unwritten = write_all(plan.overrides, plan.solved(meshes))
            _settle(plan, meshes, None)
        self.problems = [*problems, *unwritten]

    def write_to_file(self, plan: Plan, meshes: Sequence[LiveMesh]) -> None:
        """Write all that is solved until `out_of_file` takes it back."""
        try:
            with contextlib.ExitStack() as stack, _selection_untouched():
                stack.enter_context(write_for_file(plan.overrides, plan.solved(meshes)))
                _settle(plan, meshes, stack)
                self._in_file = stack.pop_all()
        except UNEXPECTED:
            _log.exception("The file is saved with the mesh as before Live")

    def out_of_file(self) -> None:
        """Take back what was written for a file."""
        with self._in_file:
            self._in_file = contextlib.nullcontext()


def _settle(plan, meshes, undo):
    for mesh, task in plan.pairs(meshes):
        if task.written is not None:
            task.written = mesh.settle(task.written, undo)


@contextlib.contextmanager
def _selection_untouched():
    """Keep active what the artist works on: the result has been there all the time."""
    objects = bpy.context.view_layer.objects
    selected, active = list(objects.selected), objects.active
    try:
        yield
    finally:
        for obj in selected:
            obj.select_set(True)
        objects.active = active
