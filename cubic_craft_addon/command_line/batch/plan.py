# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be written for each file of a batch, and with which options."""

import hashlib
import json
from argparse import Namespace
from pathlib import Path
from typing import NamedTuple

from ....solver.console.errors import InputError
from ..process.output_files import written
from .sources import Source

OF_THE_BATCH = {
    *("inputs", "input", "handles", "handles_file", "report", "error_file"),
    *("output", "save_mesh", "bake", "part"),
    *(
        "form_object",
        "capture",
        "output_folder",
        "recursive",
        "only",
        "jobs",
        "timeout",
        "memory",
        "limited",
        "force",
        "threads",
        "worker",
    ),
    *("paper", "options"),  # what they stand for is set
}
"""the options that are not handed on as they are"""


class Job(NamedTuple):
    """One file of a batch."""

    path: Path
    """absolute"""
    label: str
    """what it is called in what is printed"""
    outputs: tuple[Path, ...]
    """all that is written: pictures, then meshes"""
    record: Path
    """the report of the run that has made them"""
    arguments: tuple[str, ...]
    """of the process that does it"""
    folder: Path | None = None
    """that the file must lie in, links followed, if it was found in one"""


def plan(options: Namespace, sources: list[Source]) -> list[Job]:
    """Return one job per source, in the same order; with ``--only`` the one of that number.

    Raises InputError: there are fewer sources. A result would take the place of an input, or be
    taken for one the next time.
    """
    jobs = [_job(options, source) for source in sources]
    inputs = {
        path.resolve()
        for path in (*(s.path for s in sources), options.handles_file, *_shapes(options))
        if path
    }
    for path in (path for job in jobs for path in job.outputs):
        if path.resolve() in inputs:
            raise InputError(f"{path}: is an input; choose another --output-folder")
    folders = {path.resolve() for path in options.inputs if path.is_dir()}
    if options.save_mesh and options.output_folder.resolve() in folders:
        raise InputError(
            f"--output-folder {options.output_folder}: is the folder of the inputs as well, where "
            "the meshes would be inputs the next time; choose another, it may lie in this one"
        )
    if options.only is None:
        return jobs
    if options.only > len(jobs):
        raise InputError(f"--only {options.only}: there are {len(jobs)} files")
    return [jobs[options.only - 1]]


def settings_of(options: Namespace) -> str:
    """Return the options that are the same for each file, in one line of JSON."""
    same = {name: value for name, value in vars(options).items() if name not in OF_THE_BATCH}
    return json.dumps(same, sort_keys=True)


def decisive(options: Namespace, version: str) -> str:
    """Return all but the content of an input that decides about its results, as a text."""
    handles = options.handles_file and options.handles_file.read_text(encoding="utf-8")
    shapes = [path and hashlib.sha256(path.read_bytes()).hexdigest() for path in _shapes(options)]
    settings = settings_of(Namespace(**vars(options) | {"verbose": False}))
    ending = str(options.bake or options.save_mesh)
    return json.dumps([version, settings, ending, handles, *shapes])


def _shapes(options: Namespace) -> tuple[Path | None, Path | None]:
    """Return the files that the form and the normal capture are made from."""
    return options.form_object, options.capture


def _job(options: Namespace, source: Source) -> Job:
    folder = options.output_folder.resolve()
    record = folder / ".cubic_craft" / f"{source.name}.json"
    arguments = [str(source.path), f"--report={record}"]
    picture = mesh = None
    if not options.no_render:
        picture = folder / f"{source.name}.png"
        arguments.append(f"--output={picture}")
    if options.save_mesh:
        mesh = folder / f"{source.name}{options.save_mesh}"
        arguments.append(f"--save-mesh={mesh}")
    if options.handles_file:
        arguments.append(f"--handles={options.handles_file.absolute()}")
    if options.form_object:
        arguments.append(f"--form-object={options.form_object.absolute()}")
    if options.capture:
        arguments.append(f"--capture={options.capture.absolute()}")
    outputs = written(picture, mesh, options)
    if options.bake:
        outputs = [folder / f"{source.name}{options.bake}"]
        arguments.append(f"--bake={outputs[0]}")
    return Job(source.path, source.label, tuple(outputs), record, tuple(arguments), source.folder)
