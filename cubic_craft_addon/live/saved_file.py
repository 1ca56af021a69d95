# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file holds that is saved while Live runs: the shape on the screen, as if confirmed."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import contextlib
from collections.abc import Sequence

from .. import hidden_source, mesh_bridge
from ..run.tasks import Task, write_task
from ..settings.overrides import SettingsOverrides
from ..settings.rollback import settings_untouched


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
