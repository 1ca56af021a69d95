# SPDX-License-Identifier: GPL-3.0-or-later
"""Have the files of a batch done: one after the other here, or by workers of dask.distributed.

Dask hands the files out, and those of a worker that is lost to another one. A worker starts a
process for its file: a crash of Blender says something about the file, and ends no worker.
"""

import contextlib
import logging
import multiprocessing
import signal
import sys
from argparse import Namespace
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..interruption import before_ending
from .plan import Job
from .task import FAILED, PATIENCE, Batch, do, end_processes

__all__ = ("results_of", "workers_for")

SCRIPTS = str(Path(__file__).resolve().parents[2])
SECONDS_TO_ANSWER = 10


@contextlib.contextmanager
def workers_for(options: Namespace, files: int) -> Iterator[Any]:
    """Give a client of the workers during the block; None where this process does all.

    Raises
    ------
    InputError
        A package is not installed, or no cluster is there.
    """
    workers = min(options.jobs or 1, files)
    if not options.scheduler and workers == 1:
        before_ending(end_processes)
        yield None
        return
    # With cryptography no other user of this machine can give orders to the workers on it.
    names = ["distributed"] if options.scheduler else ["distributed", "cryptography"]
    if missing := [name for name in names if find_spec(name) is None]:
        option = "--scheduler" if options.scheduler else f"--jobs {options.jobs}"
        raise InputError(
            f"{option}: the Python package {' and '.join(missing)} is not installed; install it "
            f'with "{sys.executable}" -m pip install {" ".join(missing)}'
        )
    import dask.config

    # That a worker is lost is no news: another one does its file.
    dask.config.set({"logging.distributed": "critical"})
    with _cluster(options.scheduler) if options.scheduler else _workers_here(workers) as client:
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

    work, waiting = _work_of_a_worker(), {}
    for number, job in enumerate(jobs):
        order, key = (SCRIPTS, tuple(job), tuple(batch)), f"{job.label}-{number}-{batch.name}"
        waiting[client.submit(work, *order, key=key)] = job
    for future, result in as_completed(waiting, with_results=True, raise_errors=False):
        if future.status != "finished":  # its workers died one after the other, or all is lost
            error = result[1] if isinstance(result, tuple) else result
            result = {"status": FAILED, "error": f"no worker could do it: {error}"}
        yield waiting[future], result


def _work_of_a_worker() -> Callable[[str, tuple, tuple], dict[str, Any]]:
    """Return what a worker calls.

    A function in a function is sent as its code. The scheduler of a cluster looks into what it is
    sent, and need not have these modules.
    """

    def work(scripts: str, job: tuple, batch: tuple) -> dict[str, Any]:
        import sys

        from distributed import get_worker

        if scripts not in sys.path:
            sys.path.insert(0, scripts)
        from headless.batch.plan import Job
        from headless.batch.task import Batch, do

        worker = get_worker()
        key = worker.get_current_task()

        def is_wanted() -> bool:
            task = worker.state.tasks.get(key)
            return task is not None and task.state != "cancelled"  # as when the batch is gone

        return do(Job(*job), Batch(*batch), is_wanted)

    return work


@contextlib.contextmanager
def _cluster(address: str) -> Iterator[Any]:
    """Give a client of the scheduler at an address."""
    from distributed import Client

    try:
        client = Client(address, timeout=SECONDS_TO_ANSWER)
    except (OSError, ValueError) as error:
        reason = f"no scheduler answers there ({type(error).__name__}); start one: dask scheduler"
        raise InputError(f"--scheduler {address}: {reason}") from error
    with client:
        yield client


@contextlib.contextmanager
def _workers_here(count: int) -> Iterator[Any]:
    """Give a client of so many workers on this machine, which end with the block."""
    from distributed import Client, LocalCluster

    clusters: list[LocalCluster] = []
    before_ending(lambda: _end_workers(clusters))
    # Threads and processes inherit this. Ctrl-C is for this process only, which then ends them.
    is_posix = sys.platform != "win32"
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT}) if is_posix else ()
    cluster = LocalCluster(
        n_workers=count,
        threads_per_worker=1,
        memory_limit=0,
        security=True,
        silence_logs=logging.CRITICAL,  # in the workers
        dashboard_address="127.0.0.1:0",
    )
    if is_posix:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    with cluster, Client(cluster) as client:
        clusters.append(cluster)
        yield client


def _end_workers(clusters: list[Any]) -> None:
    """End all workers here, and wait until the processes of their files have tidied up."""
    import psutil

    for cluster in clusters:
        for nanny in cluster.workers.values():
            nanny.close_gracefully()  # or it would start its worker again
    files = []
    for worker in multiprocessing.active_children():
        with contextlib.suppress(psutil.NoSuchProcess):
            files += psutil.Process(worker.pid).children()
        worker.kill()
    for process in psutil.wait_procs(files, PATIENCE)[1]:
        process.kill()
