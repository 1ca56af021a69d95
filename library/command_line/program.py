# SPDX-License-Identifier: GPL-3.0-or-later
"""The run of the command, from its options to its exit code."""

import contextlib
import sys
import time
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path

from solver.console.errors import InputError
from solver.console.interruption import end_on_signals
from solver.console.temporary import replacing, temporary_folder

from .arguments import parse
from .formats import FORMATS
from .output_file import check_writable
from .standard_streams import STANDARD, input_file, write_to_standard_output

__all__ = ("main", "run")

PROGRAM = "cubic-craft"


def main() -> int:
    """Do what the command line of this process says, and return the exit code."""
    end_on_signals(PROGRAM)
    return run(sys.argv[1:])


def run(arguments: list[str]) -> int:
    """Do what a command line says, and return the exit code."""
    try:
        options = parse(arguments)
        return max([_exit_code(*job, options) for job in _jobs(options)])
    except InputError as error:
        _say(f"error: {error}")
        return 2


def _exit_code(source: str, output: str, options: Namespace) -> int:
    """Do one run; what is wrong with it is said, and does not hinder the others."""
    try:
        lines = _run(source, output, options)
    except InputError as error:
        _say(f"error: {error}")
        return 2
    for line in lines if not options.quiet else ():
        _say(line)
    return 0


def _say(line: str) -> None:
    print(f"{PROGRAM}: {line}", file=sys.stderr)


def _jobs(options: Namespace) -> list[tuple[str, str]]:
    """Return the input and the output of each run, which are checked before the first begins."""
    inputs, output = options.inputs, options.output
    if len(inputs) == 1:
        jobs = [(inputs[0], output)]
    elif Path(output).is_dir():
        jobs = [(source, str(Path(output) / Path(source).name)) for source in inputs]
    else:
        raise InputError(f"{output}: is not a folder, which several results need; create it")
    written: set[str] = set()
    for source, target in jobs:
        if len(jobs) > 1 and source == STANDARD:
            raise InputError("standard input can be only one; give it alone")
        _check_files(source, target)
        if target in written:
            raise InputError(f"{target}: two inputs have this name; give them one by one")
        written.add(target)
    return jobs


def _check_files(source: str, output: str) -> None:
    for path in (Path(name) for name in (source, output) if name != STANDARD):
        if path.suffix.lower() not in FORMATS:
            kind = f"{path.suffix!r} files" if path.suffix else "files without a suffix"
            raise InputError(f"{path}: {kind} are not supported; give {', '.join(FORMATS)}")
    if output != STANDARD:
        check_writable(Path(output))
        if Path(source).resolve() == Path(output).resolve():
            raise InputError(f"{output}: this is the input; give another name")


def _run(source: str, output: str, options: Namespace) -> list[str]:
    """Read, stylize and write; return a summary, and notes."""
    # Late, because they take a while to import: --help and mistyped options need none.
    from . import mesh_files
    from .style import stylized

    begin = time.perf_counter()
    with input_file(source) as path:
        file = mesh_files.read(path)
        try:
            result = stylized(file.surface, options)
        except InputError as error:
            raise InputError(f"{path}: {error}") from None
        suffix = f".{options.format}" if options.format else path.suffix
    with _output_file(output, suffix) as temporary:
        try:
            notes = mesh_files.write(file, temporary, result.positions, result.rotations)
        except InputError as error:
            raise InputError(f"{output}: {error}") from None
    seconds = time.perf_counter() - begin
    end = "converged" if result.converged else "NOT converged"
    if result.crossings:
        end += f", {result.crossings} faces still cross"
    summary = (
        f"{output}: {len(file.surface.points)} vertices, {file.surface.face_count} faces, "
        f"{result.iterations} iterations, {end}, energy {result.energy.total:.5g}, "
        f"{result.device}, {seconds:.1f} s"
    )
    return [summary, *(f"note: {note}" for note in notes)]


@contextlib.contextmanager
def _output_file(output: str, suffix: str) -> Iterator[Path]:
    """Give a path to write to, which becomes the output when the block succeeds."""
    if output != STANDARD:
        with replacing(Path(output)) as temporary:
            yield temporary
        return
    with temporary_folder() as folder:
        path = folder / f"output{suffix}"
        yield path
        write_to_standard_output(path)
