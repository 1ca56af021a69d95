# SPDX-License-Identifier: GPL-3.0-or-later
"""The run of the command, from its options to its exit code."""

import sys
import time
from argparse import Namespace
from collections import Counter
from pathlib import Path
from typing import Any

from solver.console.interruption import end_on_signals
from solver.console.many import in_words, one_by_one
from solver.console.output import InputError, check_outputs, refusals_of, replacing
from solver.console.run_words import end_words, numbers_of
from solver.console.sources import check_source, check_suffix, find_sources, make_folder

from .arguments import FORMATS, parse

PROGRAM = "cubic-craft"


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
        check_suffix(target, Path(target), FORMATS)
        if target in written:
            raise InputError(f"{target}: two inputs have this name; give them one by one")
        written.add(target)
    if is_batch:
        if output.is_file():
            raise InputError(f"{output}: is a file; several results need a folder")
        make_folder(str(output), output)
    for _, target in jobs:
        check_outputs("", [Path(target)], inputs)
    if options.report:
        check_outputs("--report", [options.report])
        check_suffix(f"--report {options.report}", options.report, (".json",))
    return jobs, kinds


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
    return {
        "outputs": [output],
        "seconds": seconds,
        "vertices": len(file.points),
        "faces": file.face_count,
        **numbers_of(result),
        "device": result.device,
        "notes": notes,
    }
