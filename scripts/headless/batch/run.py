"""Run a batch: as many files at a time as there are jobs, until all are done or have failed."""

import math
import os
import textwrap
import time
from argparse import Namespace
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..interruption import before_ending
from ..output_files import check_writable, remove_left_behind
from ..progress import ProgressBar, Task
from .batch_report import write_batch_report
from .outcome import DONE, FAILED, KEPT, Outcome, counts
from .plan import FORWARDED, Job, plan
from .records import key_of, read_record, write_record
from .sources import find_sources
from .table import one_line, summary, table
from .workers import Workers, why_failed

__all__ = ("SOME_FAILED", "run_batch")

SOME_FAILED = 3
"""exit code"""
WIDEST = 40
"""letters in front of the progress bar, so that it stays in its line"""


def run_batch(
    options: Namespace,
    command: Callable[[int | None], list[str]],
    version: str,
    program: str,
    begin: float,
) -> int:
    """Do what the command line says, and return the exit code.

    Parameters
    ----------
    options : from `arguments.parse`, with an ``output_folder``
    command : gives what starts the script, from the number of threads (None for all)
    version : of CubicCraft
    program : what the script calls itself
    begin : `time.perf_counter` at the start of the script

    Raises
    ------
    InputError
        Nothing can be done at all; what is wrong with a file is in the table.
    """
    sources = find_sources(options.inputs, options.recursive, options.output_folder)
    jobs = plan(options, sources)
    _make_folders(options.output_folder, jobs)
    threads = options.threads or _share(options.jobs or 1)
    batch = _Batch(options, Workers(command(threads), threads), threads, version, program)
    outcomes = batch.run(jobs)
    bar = ProgressBar()
    for line in table(outcomes, options.output_folder):
        bar.say(line)
    is_complete = True
    if options.report:
        seconds = time.perf_counter() - begin
        try:
            write_batch_report(options.report, outcomes, options.output_folder, seconds)
            bar.say(f"wrote {options.report}")
        except InputError as error:  # which says elsewhere that nothing was begun
            is_complete = False
            bar.warn(f"{program}: error: {error}")
    if failed := counts(outcomes)[FAILED]:
        is_complete = False
        bar.warn(f"{program}: {failed} of {len(outcomes)} files failed")
    return 0 if is_complete else SOME_FAILED


class _Batch:
    """What the files of a batch share while it runs."""

    def __init__(
        self,
        options: Namespace,
        workers: Workers,
        threads: int | None,
        version: str,
        program: str,
    ) -> None:
        self._options = options
        self._workers = workers
        self._threads = [f"--threads={threads}"] if threads else []
        self._version = version
        self._error_begin = f"{program}: error: "
        self._bar = ProgressBar(memory=math.inf)
        self._task = Task()
        self._labels: list[str] = []
        """of the files that are being worked on"""
        self._said: set[str] = set()

    def run(self, jobs: list[Job]) -> list[Outcome]:
        """Do the jobs; return how each went, in their order."""
        before_ending(self._workers.end)
        total, kept = len(jobs), 0
        with (
            ThreadPoolExecutor(self._options.jobs or 1) as pool,
            self._bar.task(f"{total} files") as self._task,
        ):
            futures = [pool.submit(self._do, job) for job in jobs]
            for number, future in enumerate(as_completed(futures), start=1):
                outcome = future.result()
                label = one_line(outcome.job.source.label)
                self._bar.say(f"{number} of {total}, {label}: {summary(outcome)}")
                kept += outcome.status == KEPT  # at once, which says nothing of the others
                self._task.advance_to((number - kept) / max(1, total - kept))
            outcomes = [future.result() for future in futures]
            how_many = counts(outcomes).items()
            self._task.finish(", ".join(f"{count} {status}" for status, count in how_many if count))
        return outcomes

    def _do(self, job: Job) -> Outcome:
        """Do one file, in a thread of the pool."""
        try:
            key = key_of(job.source.path, self._options, FORWARDED, self._version)
            if not self._options.force and (record := read_record(job.record, key, job.outputs)):
                return Outcome(job, KEPT, record["seconds"], record["report"])
            return self._work(job, key)
        except OSError as error:
            return Outcome(job, FAILED, error=f"{error.strerror or error}: {error.filename}")
        except ValueError as error:
            return Outcome(job, FAILED, error=str(error))

    def _work(self, job: Job, key: str) -> Outcome:
        # First, as from now on the outputs may be others than it says.
        job.record.unlink(missing_ok=True)
        label = one_line(job.source.label)
        self._labels.append(label)
        self._describe()
        begin = time.perf_counter()
        code, words = self._workers.run([*job.arguments, *self._threads])
        seconds = time.perf_counter() - begin
        self._labels.remove(label)
        self._describe()
        if self._options.verbose or not code:
            for line in words.splitlines():
                self._bar.warn(f"{label}: {line}")
        if code:
            for path in (*job.outputs, job.record):
                remove_left_behind(path)
            error = why_failed(code, words, self._error_begin)
            return Outcome(job, FAILED, error=error.removeprefix(f"{job.source.path}: "))
        record = write_record(job.record, key, job.outputs, seconds)
        self._notice(record["report"])
        return Outcome(job, DONE, seconds, record["report"])

    def _notice(self, report: dict[str, Any]) -> None:
        """Print what a run has to say about the machine, the first time that one does."""
        for notice in report["notices"]:
            if notice not in self._said:
                self._said.add(notice)
                self._bar.warn(notice)

    def _describe(self) -> None:
        self._task.describe(textwrap.shorten(", ".join(self._labels), WIDEST, placeholder=" ..."))


def _make_folders(output_folder: Path, jobs: list[Job]) -> None:
    try:
        for job in jobs:
            for path in (*job.outputs, job.record):
                path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = error.strerror or error
        message = f"--output-folder {output_folder}: cannot be made ({reason}); choose another"
        raise InputError(message) from error
    for job in jobs:
        check_writable("--output-folder", [*job.outputs, job.record])


def _share(jobs: int) -> int | None:
    """Return how many threads each of so many jobs may have; None for all of them."""
    if jobs == 1:
        return None
    has_affinity = hasattr(os, "sched_getaffinity")
    count = len(os.sched_getaffinity(0)) if has_affinity else os.cpu_count() or 1
    return max(1, count // jobs)
