# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a batch: tell how each file went and write the report after it; at the end, what failed."""

import json
import math
import os
import textwrap
import time
from argparse import Namespace
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed
from functools import partial
from pathlib import Path
from typing import Any

from ....solver.console.output import InputError
from ....solver.console.report import DONE, FAILED, KEPT, counts_of, in_words, write_batch
from ....solver.console.sources import make_folder
from ..options.arguments import Worker
from ..process.output_files import check_writable
from ..process.progress import ProgressBar
from ..process.quiet import one_line
from ..process.version import version
from .sources import find_sources
from .task import Job, do, job_of, key_of

SOME_FAILED = 3
"""exit code"""
SEEN_AT_ONCE = 20
"""lines: of more files, those that failed are named once more at the end"""
WIDEST = 40
"""letters in front of the progress bar, so that it stays in its line"""


def run_batch(
    options: Namespace,
    arguments: list[str],
    command: Callable[[int | None], list[str]],
    program: str,
) -> int:
    """Do what the command line says, and return the exit code.

    `options`: from `arguments.parse`, with an ``output_folder``. `arguments`: what they were read
    from. `command`: gives what starts the script, from the number of threads (None for all).
    `program`: what the script calls itself. Raises InputError: nothing can be done at all; what is
    wrong with a file is said of it.
    """
    bar = ProgressBar(memory=math.inf)
    sources, kinds = find_sources(options.inputs, options.recursive, options.output_folder)
    jobs = [job_of(options, name, path) for name, path in sources.items()]
    _check(options, jobs)
    if options.only is not None:
        if options.only > len(jobs):
            raise InputError(f"--only {options.only}: there are {len(jobs)} files")
        jobs = [jobs[options.only - 1]]
    count = min(options.jobs or 1, len(jobs))
    options.threads = options.threads or _share(count)
    start = command(options.threads)
    _make_folders(options.output_folder, jobs)
    if kinds:
        bar.say(f"left out, of kinds that are not read: {one_line(in_words(kinds))}")

    def work(job: Job) -> dict[str, Any]:
        task.describe(textwrap.shorten(_label(job), WIDEST, placeholder=" ..."))
        try:
            key = key_of(job.path, options, version())
            worker = json.dumps(Worker(str(job.path), job.name, key))
            return do(job, options, [*start, f"--worker={worker}", *arguments], key)
        except OSError as error:
            return {"status": FAILED, "error": f"{error.strerror or error}: {error.filename}"}

    head = {"output_folder": str(options.output_folder.resolve()), "kinds_left_out": kinds}
    report = options.report and partial(
        write_batch, options.report, head, len(jobs), time.perf_counter()
    )
    with bar.task(f"{len(jobs)} files") as task, ThreadPoolExecutor(count) as pool:
        # A thread waits for each process: a crash of Blender ends no other.
        waiting = {pool.submit(work, job): job for job in jobs}
        results = ((waiting[future], future.result()) for future in as_completed(waiting))
        files, error = _told(results, jobs, options, bar, report, task)
    failed = [job for job, about in files.items() if about["status"] == FAILED]
    if error:  # exit code 2 says elsewhere that nothing was begun
        bar.warn(f"{program}: error: {error}")
    elif options.report:
        bar.say(f"wrote {options.report}")
    if failed:
        for job in failed if len(files) > SEEN_AT_ONCE else ():
            bar.warn(f"{_label(job)}: {_summary(files[job])}")
        bar.warn(f"{program}: {len(failed)} of {len(files)} files failed")
    return SOME_FAILED if failed or error else 0


def _told(results, jobs, options, bar, report, task) -> tuple[dict[Job, dict[str, Any]], str]:
    """Print a line for each result (a job, and what `task.do` returns) as it comes.

    Returns what the report has of them, in order, and why that could not be written at last.
    """
    files: dict[Job, dict[str, Any]] = {}
    folder, notices, error = options.output_folder.resolve(), set(), ""
    for job, result in results:
        words = result.pop("words", "").splitlines()
        files[job] = about = {"input": str(job.path), **result}
        has_failed = about["status"] == FAILED
        bar.say(f"{len(files)} of {len(jobs)}, {_label(job)}: {_summary(about)}")
        if options.verbose or not has_failed:
            for line in words:
                bar.warn(f"{_label(job)}: {line}")
        if not has_failed:
            about["outputs"] = [path.relative_to(folder).as_posix() for path in job.outputs]
        if about["status"] == DONE:
            for notice in set(about["report"]["notices"]) - notices:  # about the machine
                bar.warn(notice)
                notices.add(notice)
        if report:
            try:
                report([files[job] for job in jobs if job in files])
                error = ""
            except (InputError, OSError) as reason:
                error = str(reason)
        kept = counts_of(files.values())[KEPT]  # at once, which tells nothing of others
        task.advance_to((len(files) - kept) / max(1, len(jobs) - kept))
    counts = counts_of(files.values()).items()
    task.finish(", ".join(f"{count} {status}" for status, count in counts if count))
    return {job: files[job] for job in jobs}, error


def _check(options: Namespace, jobs: list[Job]) -> None:
    """Refuse results in the place of inputs, or that are taken for inputs the next time."""
    given = (options.handles_file, options.form_object, options.capture)
    inputs = {path.resolve() for path in (*(job.path for job in jobs), *given) if path}
    for path in (path for job in jobs for path in job.outputs):
        if path.resolve() in inputs:
            raise InputError(f"{path}: is an input; choose another --output-folder")
    folders = {path.resolve() for path in options.inputs if path.is_dir()}
    if options.save_mesh and options.output_folder.resolve() in folders:
        raise InputError(
            f"--output-folder {options.output_folder}: is the folder of the inputs as well, where "
            "the meshes would be inputs the next time; choose another, it may lie in this one"
        )


def _make_folders(output_folder: Path, jobs: list[Job]) -> None:
    for folder in {path.parent for job in jobs for path in (*job.outputs, job.record)}:
        make_folder(f"--output-folder {output_folder}", folder)
    for job in jobs:
        check_writable("--output-folder", [*job.outputs, job.record])


def _share(jobs: int) -> int | None:
    """Return how many threads each of so many jobs may have; None for all of them."""
    if jobs == 1:
        return None
    has_affinity = hasattr(os, "sched_getaffinity")
    count = len(os.sched_getaffinity(0)) if has_affinity else os.cpu_count() or 1
    return max(1, count // jobs)


def _label(job: Job) -> str:
    return one_line(f"{job.name}{job.path.suffix}")


def _summary(about: dict[str, Any]) -> str:
    if about["status"] == FAILED:
        return f"failed: {one_line(about['error'])}"
    if about["status"] == KEPT:
        return "kept, it was done before"
    return f"{_numbers(about['report'])}, {about['seconds']:.1f} s"


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
