# SPDX-License-Identifier: GPL-3.0-or-later
"""The run of the command, from its options to its exit code."""

import stat
import sys
import time
from argparse import Namespace
from collections import Counter
from pathlib import Path
from typing import Any

from solver.console.crossing_words import end_words
from solver.console.interruption import end_on_signals
from solver.console.many import in_words, one_by_one
from solver.console.output import InputError, check_folder, check_place, refusals_of, replacing
from solver.console.sources import check_source, find_sources, listing, make_folder

from .arguments import FORMATS, parse

PROGRAM = "cubic-craft"
_WRITABLE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH


def main() -> int:
    """Do what the command line of this process says, and return the exit code."""
    end_on_signals(PROGRAM)
    return run(sys.argv[1:])


def run(arguments: list[str]) -> int:
    """Do what a command line says, and return the exit code."""
    try:
        options = parse(arguments)
        jobs, kinds = _jobs(options)
    except InputError as error:
        _say(f"error: {error}")
        return 2
    if kinds and not options.quiet:
        _say(f"left out, of kinds that are not read: {in_words(kinds)}")
    each = [(source, (source, output)) for source, output in jobs]
    return one_by_one(each, lambda job: _run(job[0], job[1], options), _say, options.report)


def _say(line: str) -> None:
    print(f"{PROGRAM}: {line}", file=sys.stderr)


def _jobs(options: Namespace) -> tuple[list[tuple[str, str]], Counter[str]]:
    """Return the input and the output of each run, which are checked before the first begins.

    And how many files of which kinds lie in the folders that were given, but are none that can be
    read.
    """
    given = [Path(path) for path in options.inputs]
    found, kinds = find_sources(given, FORMATS, "give another folder")
    inputs, output = [path for path, _ in found], Path(options.output)
    is_batch = inputs != given or len(inputs) > 1
    jobs = [(str(inputs[0]), options.output)]
    if is_batch or output.is_dir():
        jobs = [(str(source), str(output / source.name)) for source in inputs]
    written: set[str] = set()
    for source, target in jobs:
        check_source(Path(source), FORMATS)
        if Path(target).suffix.lower() not in FORMATS:
            raise InputError(f"{target}: the name must end in {listing(FORMATS)}")
        if target in written:
            raise InputError(f"{target}: two inputs have this name; give them one by one")
        written.add(target)
    if is_batch:
        if output.is_file():
            raise InputError(f"{output}: is a file; several results need a folder")
        make_folder(str(output), output)
    for source, target in jobs:
        _check_output(source, target)
    if options.report:
        _check_writable(options.report)
        if options.report.suffix.lower() != ".json":
            raise InputError(f"--report {options.report}: the name must end in .json")
    return jobs, kinds


def _check_writable(path: Path) -> None:
    check_place(str(path), path)
    if path.is_symlink():
        raise InputError(f"{path}: this is a link, which is not replaced; give another name")
    if path.exists() and not path.stat().st_mode & _WRITABLE:
        raise InputError(f"{path}: this file is write-protected; give another name")
    if path.exists() and not path.is_file():
        raise InputError(f"{path}: is a device or a pipe; give a file")
    check_folder(str(path), path.parent)


def _check_output(source: str, output: str) -> None:
    _check_writable(Path(output))
    if Path(source).resolve() == Path(output).resolve():
        raise InputError(f"{output}: this is the input; give another name")


def _run(source: str, output: str, options: Namespace) -> dict[str, Any]:
    """Read, stylize and write; say how that went, and return what the report has."""
    # Late, because they take a while to import: --help and mistyped options need none.
    from . import scene_file
    from .style import stylized

    begin = time.perf_counter()
    file = scene_file.read(Path(source))
    with refusals_of(source):
        result = stylized(file.points, file.faces, options)
    with replacing(Path(output)) as temporary:
        try:
            notes = scene_file.write(file, temporary, result.positions, result.rotations)
        except InputError as error:
            raise InputError(f"{output}: {error}") from None
    seconds = time.perf_counter() - begin
    end = end_words("converged" if result.converged else "NOT converged", result)
    summary = (
        f"{output}: {len(file.points)} vertices, {file.face_count} faces, "
        f"{result.iterations} iterations, {end}, energy {result.energy.total:.5g}, "
        f"{result.device}, {seconds:.1f} s"
    )
    for line in (summary, *(f"note: {note}" for note in notes)) if not options.quiet else ():
        _say(line)
    numbers = {name: getattr(result.energy, name) for name in ("total", "arap", "cubic")}
    return {
        "outputs": [output],
        "seconds": seconds,
        "vertices": len(file.points),
        "faces": file.face_count,
        "iterations": result.iterations,
        "converged": bool(result.converged),
        "crossings": result.crossings,
        "energy": {name: float(value) for name, value in numbers.items()},
        "device": result.device,
        "notes": notes,
    }
