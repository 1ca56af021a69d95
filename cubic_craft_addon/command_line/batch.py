# SPDX-License-Identifier: GPL-3.0-or-later
"""Many files, one after the other in one Blender; one that fails is told, and the next goes on."""

import os
import time
from argparse import Namespace
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from ...solver.console import sources
from ...solver.console.many import KEPT, in_words, one_by_one
from ...solver.console.output import InputError, check_outputs
from ...solver.console.sources import folded
from .options.arguments import options_for
from .options.formats import READABLE
from .process.output_files import written
from .process.progress import say
from .process.quiet import one_line


class Job(NamedTuple):
    """One file of a batch."""

    path: Path
    options: Namespace
    """of a run with this file alone"""
    outputs: list[Path]

    @property
    def is_done(self) -> bool:
        """Whether all that it writes is there, and newer than it."""
        changed = self.path.stat().st_mtime
        return all(path.is_file() and path.stat().st_mtime >= changed for path in self.outputs)


def run_batch(
    jobs: list[Job],
    options: Namespace,
    run: Callable[[Namespace, float], dict[str, Any]],
    complain: Callable[[str], None],
) -> int:
    """Do all jobs of a batch, and return the exit code.

    `run`: does what the options of one file say and returns its report; it is given when that
    begins. `complain`: prints a line about what is wrong.
    """
    count = len(jobs)

    def work(numbered: tuple[int, Job]) -> dict[str, Any]:
        number, job = numbered
        outputs = [str(path) for path in job.outputs]
        is_kept = bool(outputs) and job.is_done and not options.force
        end = ": kept, it was done before" if is_kept else ""
        say(f"{number} of {count}, {one_line(job.path.name)}{end}")
        if is_kept:
            return {"status": KEPT, "outputs": outputs}
        return {"outputs": outputs, "report": run(job.options, time.perf_counter())}

    each = [(str(job.path), (number, job)) for number, job in enumerate(jobs, 1)]
    return one_by_one(each, work, complain, options.report)


def jobs_of(options: Namespace) -> list[Job]:
    """Return what there is to do, and say how many files there are of kinds that are not read.

    Makes the folders of the results. Raises InputError: a folder holds nothing to do, results would
    have one name or take the place of inputs, or a folder cannot be written to.
    """
    cure = "give another folder" if options.recursive else "give another, or add --recursive"
    found, kinds = sources.find_sources(
        options.inputs,
        READABLE,
        cure,
        is_recursive=options.recursive,
        left_out=options.output_folder,
    )
    jobs = []
    for name, path in _named(found).items():
        own = options_for(options, name, path)
        jobs.append(Job(path, own, written(own)))
    folders = {path.resolve() for path in options.inputs if path.is_dir()}
    if options.save_mesh and options.output_folder.resolve() in folders:
        raise InputError(
            f"--output-folder {options.output_folder}: is the folder of the inputs as well, where "
            "the meshes would be inputs the next time; choose another, it may lie in this one"
        )
    inputs = [*(job.path for job in jobs), options.handles_file, options.form_object]
    for folder in {path.parent for job in jobs for path in job.outputs} | {options.output_folder}:
        sources.make_folder(f"--output-folder {options.output_folder}", folder)
    for job in jobs:
        if job.outputs:
            check_outputs("--output-folder", job.outputs, filter(None, inputs))
    if kinds:
        say(f"left out, of kinds that are not read: {one_line(in_words(kinds))}")
    return jobs


def _named(found: list[tuple[Path, Path]]) -> dict[str, Path]:
    """Name the results of files, each given with its folder, by their place in that.

    Those that share a name get their suffix too, so that it is the same whenever it is given.
    Raises InputError: that is not enough.
    """
    # Links stay what they are called.
    places = {os.path.abspath(path): (path, path.relative_to(folder)) for path, folder in found}  # noqa: PTH100
    count = Counter(folded(place.with_suffix("").as_posix()) for _, place in places.values())
    named: dict[str, Path] = {}
    taken: dict[str, Path] = {}
    for path, place in places.values():
        name = place.with_suffix("").as_posix()
        if count[folded(name)] > 1:
            name = place.with_name(f"{place.stem}_{place.suffix[1:]}").as_posix()
        other = taken.setdefault(folded(name), path)
        if other != path:
            raise InputError(f"{path}: its results would have the names of {other}; rename it")
        named[name] = path
    return named
