# SPDX-License-Identifier: GPL-3.0-or-later
"""Have the files of a batch done: one after the other, or handed out by dask.distributed.

Here its workers are threads of this process; on a cluster, where workers may be lost, another one
does the file. Each starts a process for its file: a crash of Blender ends no worker.
"""

import contextlib
import logging
import sys
from argparse import Namespace
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Any

from ....solver.console.errors import InputError
from ....solver.console.interruption import before_ending
from ..process.watched_process import end_processes
from .elsewhere import PLACE, work_elsewhere
from .plan import Job
from .task import FAILED, Batch, do

__all__ = ("results_of", "workers_for")

SECONDS_TO_ANSWER = 10
WITHOUT_PAGES = {f"distributed.{who}.http.routes": [] for who in ("scheduler", "worker")}
HERE_ONLY = {
    **{name: "127.0.0.1:0" for name in ("dashboard_address", "worker_dashboard_address")},
    "scheduler_kwargs": {"dashboard": False},
}
"""what Dask listens on, which it always does: by default for all of the network"""


@contextlib.contextmanager
def workers_for(options: Namespace, files: int) -> Iterator[Any]:
    """Give a client of the workers during the block; None where one file is done at a time.

    Raises
    ------
    InputError
        Dask is not installed, or no cluster is there.
    """
    before_ending(end_processes)
    address, count = options.scheduler, min(options.jobs or 1, files)
    if not address and count == 1:
        yield None
        return
    if find_spec("distributed") is None:
        option = "--scheduler" if address else f"--jobs {options.jobs}"
        raise InputError(
            f"{option}: the Python package distributed is not installed; install it "
            f'with "{sys.executable}" -m pip install distributed'
        )
    import dask.config

    # That a worker is lost is no news: another one does its file.
    dask.config.set({"logging.distributed": "critical", **WITHOUT_PAGES})
    from distributed import Client, Worker

    class WithoutPage(Worker):
        def __init__(self, *arguments: Any, **how: Any) -> None:
            super().__init__(*arguments, **how | {"dashboard": False})

    threads = {"processes": False, "n_workers": 1, "threads_per_worker": count, "memory_limit": 0}
    quiet = {"worker_class": WithoutPage, "silence_logs": logging.CRITICAL}
    own = {**HERE_ONLY, **quiet, **threads}
    try:
        client = Client(address, timeout=SECONDS_TO_ANSWER) if address else Client(**own)
    except (OSError, ValueError) as error:
        if not address:
            raise
        reason = f"no scheduler answers there ({type(error).__name__}); start one: dask scheduler"
        raise InputError(f"--scheduler {address}: {reason}") from error
    with client:
        yield client


def results_of(
    jobs: list[Job], batch: Batch, client: Any, say_begun: Callable[[Job], None]
) -> Iterator[tuple[Job, dict[str, Any]]]:
    """Do the jobs; yield each with what `task.do` returns, as soon as it is done.

    Parameters
    ----------
    client : from `workers_for`
    say_begun : called with a job that is begun, where that is known
    """
    if client is None:
        for job in jobs:
            say_begun(job)
            yield job, do(job, batch)
        return
    from distributed import as_completed

    work, waiting = work_elsewhere(), {}
    for number, job in enumerate(jobs):
        order, key = (PLACE, tuple(job), tuple(batch)), f"{job.label}-{number}-{batch.name}"
        waiting[client.submit(work, *order, key=key)] = job
    for future, result in as_completed(waiting, with_results=True, raise_errors=False):
        if future.status != "finished":  # its workers died one after the other, or all is lost
            error = result[1] if isinstance(result, tuple) else result
            result = {"status": FAILED, "error": f"no worker could do it: {error}"}
        yield waiting[future], result
