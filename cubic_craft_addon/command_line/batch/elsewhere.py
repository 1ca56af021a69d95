# SPDX-License-Identifier: GPL-3.0-or-later
"""What a worker of Dask is sent, which may be on another machine, in a process without Blender."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...environment.package import ROOT_PACKAGE

__all__ = ("PLACE", "work_elsewhere")

PLACE = (str(Path(__file__).resolve().parents[3]), ROOT_PACKAGE)
"""folder of the extension, which is the same on all machines, and the name of its package"""


def work_elsewhere() -> Callable[[tuple, tuple, tuple], dict[str, Any]]:
    """Return what a worker calls.

    A function in a function is sent as its code. The scheduler of a cluster looks into what it is
    sent, and need not have these modules.
    """

    def work(place: tuple, job: tuple, batch: tuple) -> dict[str, Any]:
        import importlib
        import sys
        import types

        from distributed import get_worker

        root, package = place
        if package not in sys.modules:  # no Blender has loaded the extension here
            extension = types.ModuleType(package)
            extension.__path__ = [root]
            sys.modules[package] = extension
        batches = f"{package}.cubic_craft_addon.command_line.batch"
        task = importlib.import_module(f"{batches}.task")
        plan = importlib.import_module(f"{batches}.plan")
        tasks, key = get_worker().state.tasks, get_worker().get_current_task()

        def is_wanted() -> bool:
            return key in tasks and tasks[key].state != "cancelled"  # as when the batch is gone

        return task.do(plan.Job(*job), task.Batch(*batch), is_wanted)

    return work
