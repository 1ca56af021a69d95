# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a batch, tell how each file went, and write the report and the table at the end."""

import math
import os
import textwrap
import time
import uuid
from argparse import Namespace
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ....solver.console.errors import InputError
from ....solver.console.temporary import replacing
from ..process.one_line import one_line
from ..process.output_files import check_writable, write_json
from ..process.progress import ProgressBar
from ..trust.symlinks import refuse_links
from .engine import results_of, workers_for
from .plan import Job, decisive, plan, settings_of
from .sources import find_sources
from .table import summary, table
from .task import DONE, FAILED, KEPT, Batch

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
    bar, left_out = ProgressBar(memory=math.inf), []
    given = (options.inputs, options.recursive, options.output_folder)
    jobs = plan(options, find_sources(*given, left_out.append))
    threads = options.threads or _share(min(options.jobs or 1, len(jobs)))
    settings, decides = settings_of(options), decisive(options, version)
    name, limits = uuid.uuid4().hex, (options.timeout, options.memory)
    batch = Batch(name, command(threads), threads, settings, decides, options.force, limits)
    with workers_for(options, len(jobs)) as client:
        _make_folders(options.output_folder, jobs)
        for path in left_out:
            bar.say(f"{one_line(str(path))}: left out, {_why_left_out(path)}")
        files = _do_all(jobs, batch, client, options, bar)
    for line in table(files):
        bar.say(line)
    counts = _counts(files)
    code = SOME_FAILED if counts[FAILED] else 0
    if options.report:
        try:
            report = {
                "output_folder": str(options.output_folder.resolve()),
                "counts": counts,
                "left_out": [str(path.absolute()) for path in left_out],
                "files": list(files.values()),
                "seconds": {"total": time.perf_counter() - begin},
            }
            write_json(options.report, report)
            bar.say(f"wrote {options.report}")
        except InputError as error:  # which says elsewhere that nothing was begun
            code = SOME_FAILED
            bar.warn(f"{program}: error: {error}")
    if options.error_file and _write_error(options.error_file, list(files.values())):
        code = 0
    if counts[FAILED]:
        bar.warn(f"{program}: {counts[FAILED]} of {len(files)} files failed")
    return code


def _do_all(
    jobs: list[Job], batch: Batch, client: Any, options: Namespace, bar: ProgressBar
) -> dict[Job, dict[str, Any]]:
    """Do all jobs, and print a line for each; return what the report has of them, in order."""
    files: dict[Job, dict[str, Any]] = {}
    folder, notices = options.output_folder.resolve(), set()
    with bar.task(f"{len(jobs)} files") as task:

        def say_begun(job: Job) -> None:
            task.describe(textwrap.shorten(one_line(job.label), WIDEST, placeholder=" ..."))

        for job, result in results_of(jobs, batch, client, say_begun):
            words = result.pop("words", "").splitlines()
            files[job] = about = {"input": str(job.path), **result}
            label, has_failed = one_line(job.label), about["status"] == FAILED
            bar.say(f"{len(files)} of {len(jobs)}, {label}: {summary(about)}")
            if options.verbose or not has_failed:
                for line in words:
                    bar.warn(f"{label}: {line}")
            if not has_failed:
                about["outputs"] = [path.relative_to(folder).as_posix() for path in job.outputs]
            if about["status"] == DONE:
                for notice in set(about["report"]["notices"]) - notices:  # about the machine
                    bar.warn(notice)
                    notices.add(notice)
            kept = _counts(files)[KEPT]  # at once, which says nothing of the others
            task.advance_to((len(files) - kept) / max(1, len(jobs) - kept))
        counts = _counts(files).items()
        task.finish(", ".join(f"{count} {status}" for status, count in counts if count))
    return {job: files[job] for job in jobs}


def _write_error(path: Path, files: list[dict[str, Any]]) -> bool:
    """Write why the one file cannot be used; return whether that is so."""
    (about,) = files
    if not about.get("refused"):
        path.unlink(missing_ok=True)
        return False
    with replacing(path) as temporary:
        temporary.write_text(f"{about['input']}: {about['error']}\n", encoding="utf-8")
    return True


def _why_left_out(path: Path) -> str:
    return "as it is hidden" if path.name[0] == "." else "as it is not a regular file"


def _counts(files: dict[Job, dict[str, Any]]) -> dict[str, int]:
    statuses = Counter(about["status"] for about in files.values())
    return {status: statuses[status] for status in (DONE, KEPT, FAILED)}


def _make_folders(output_folder: Path, jobs: list[Job]) -> None:
    folders = {path.parent for job in jobs for path in (*job.outputs, job.record)}
    refuse_links("--output-folder", output_folder, folders)
    try:
        for folder in folders:
            folder.mkdir(parents=True, exist_ok=True)
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
