# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a batch: tell how each file went and write the report after it; at the end, what failed."""

import math
import os
import textwrap
from argparse import Namespace
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from ....solver.console.errors import InputError
from ....solver.console.interruption import before_ending
from ....solver.console.report import DONE, FAILED, KEPT, BatchReport, counts_of, in_words
from ....solver.console.temporary import replacing
from ..process.one_line import one_line
from ..process.output_files import check_writable
from ..process.progress import ProgressBar
from ..process.watched_process import Limits, end_processes
from ..trust.symlinks import refuse_links
from .plan import Job, decisive, plan, settings_of
from .sources import find_sources
from .task import Batch, do

SOME_FAILED = 3
"""exit code"""
SEEN_AT_ONCE = 20
"""lines: of more files, those that failed are named once more at the end"""
WIDEST = 40
"""letters in front of the progress bar, so that it stays in its line"""


def run_batch(
    options: Namespace, command: Callable[[int | None], list[str]], version: str, program: str
) -> int:
    """Do what the command line says, and return the exit code.

    Parameters
    ----------
    options : from `arguments.parse`, with an ``output_folder``
    command : gives what starts the script, from the number of threads (None for all)
    version : of CubicCraft
    program : what the script calls itself

    Raises
    ------
    InputError
        Nothing can be done at all; what is wrong with a file is said of it.
    """
    before_ending(end_processes)
    bar = ProgressBar(memory=math.inf)
    found = find_sources(options.inputs, options.recursive, options.output_folder)
    jobs = plan(options, found.sources)
    count = min(options.jobs or 1, len(jobs))
    threads, limits = options.threads or _share(count), Limits(options.timeout, options.memory)
    settings, decides = settings_of(options), decisive(options, version)
    batch = Batch(command(threads), threads, settings, decides, options.force, limits)
    _make_folders(options.output_folder, jobs)
    for path in found.left_out:
        bar.say(f"{one_line(str(path))}: left out, {_why_left_out(path)}")
    if found.kinds:
        bar.say(f"left out, of kinds that are not read: {one_line(in_words(found.kinds))}")
    report = None
    if options.report:
        head = {
            "output_folder": str(options.output_folder.resolve()),
            "left_out": [str(path.absolute()) for path in found.left_out],
            "kinds_left_out": found.kinds,
        }
        report = BatchReport(options.report, head, len(jobs))
    files, error = _do_all(jobs, batch, count, options, bar, report)
    failed = [job for job, about in files.items() if about["status"] == FAILED]
    code = SOME_FAILED if failed or error else 0
    if error:  # exit code 2 says elsewhere that nothing was begun
        bar.warn(f"{program}: error: {error}")
    elif options.report:
        bar.say(f"wrote {options.report}")
    if options.error_file and _write_error(options.error_file, list(files.values())):
        code = 0
    if failed:
        for job in failed if len(files) > SEEN_AT_ONCE else ():
            bar.warn(f"{one_line(job.label)}: {_summary(files[job])}")
        bar.warn(f"{program}: {len(failed)} of {len(files)} files failed")
    return code


def _do_all(
    jobs: list[Job],
    batch: Batch,
    count: int,
    options: Namespace,
    bar: ProgressBar,
    report: BatchReport | None,
) -> tuple[dict[Job, dict[str, Any]], str]:
    """Do all jobs, so many at a time, and print a line for each.

    Returns what the report has of them, in order, and why that could not be written at last.
    """
    files: dict[Job, dict[str, Any]] = {}
    folder, notices, error = options.output_folder.resolve(), set(), ""
    with bar.task(f"{len(jobs)} files") as task:

        def say_begun(job: Job) -> None:
            task.describe(textwrap.shorten(one_line(job.label), WIDEST, placeholder=" ..."))

        for job, result in _results(jobs, batch, count, say_begun):
            words = result.pop("words", "").splitlines()
            files[job] = about = {"input": str(job.path), **result}
            label, has_failed = one_line(job.label), about["status"] == FAILED
            bar.say(f"{len(files)} of {len(jobs)}, {label}: {_summary(about)}")
            if options.verbose or not has_failed:
                for line in words:
                    bar.warn(f"{label}: {line}")
            if not has_failed:
                about["outputs"] = [path.relative_to(folder).as_posix() for path in job.outputs]
            if about["status"] == DONE:
                for notice in set(about["report"]["notices"]) - notices:  # about the machine
                    bar.warn(notice)
                    notices.add(notice)
            if report:
                error = _written(report, [files[job] for job in jobs if job in files], about)
            kept = counts_of(list(files.values()))[KEPT]  # at once, which tells nothing of others
            task.advance_to((len(files) - kept) / max(1, len(jobs) - kept))
        counts = counts_of(list(files.values())).items()
        task.finish(", ".join(f"{count} {status}" for status, count in counts if count))
    return {job: files[job] for job in jobs}, error


def _results(
    jobs: list[Job], batch: Batch, count: int, say_begun: Callable[[Job], None]
) -> Iterator[tuple[Job, dict[str, Any]]]:
    """Give each job with what `task.do` returns, as soon as it is done.

    A thread waits for each process: a crash of Blender ends no other.
    """

    def work(job: Job) -> dict[str, Any]:
        say_begun(job)
        return do(job, batch)

    with ThreadPoolExecutor(count) as pool:
        waiting = {pool.submit(work, job): job for job in jobs}
        for future in as_completed(waiting):
            yield waiting[future], future.result()


def _written(report: BatchReport, files: list[dict[str, Any]], newest: dict[str, Any]) -> str:
    """Write the report; return why it cannot be written, or nothing."""
    try:
        report.write(files, newest)
    except (InputError, OSError) as error:
        return str(error)
    return ""


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


def _summary(about: dict[str, Any]) -> str:
    """Return one line about a file, without its name, from what `task.do` returns."""
    if about["status"] == FAILED:
        return f"failed: {one_line(about['error'])}"
    if about["status"] == KEPT:
        return "kept, it was done before"
    memory = f", {about['peak_gb']:.2f} GB" if about["peak_gb"] else ""
    return f"{_numbers(about['report'])}, {about['seconds']:.1f} s{memory}"


def _numbers(report: dict[str, Any]) -> str:
    """Return the numbers of all objects of the file together, one after the other per cubeness."""
    if "frames" in report:
        first, last = report["frames"]
        return f"{last - first + 1} frames"
    objects, texts = report["objects"], []
    for runs in zip(*(each["runs"] for each in objects), strict=True):
        end = "converged" if all(run["converged"] for run in runs) else "not converged"
        texts.append(
            f"cubeness {runs[0]['cubeness']}: {max(run['iterations'] for run in runs)} iterations, "
            f"{end}, energy {sum(run['energy']['total'] for run in runs):.4g}"
        )
    return f"{sum(each['vertices'] for each in objects)} vertices, {'; '.join(texts)}"
