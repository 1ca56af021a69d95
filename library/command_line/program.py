# SPDX-License-Identifier: GPL-3.0-or-later
"""The run of the command, from its options to its exit code."""

import os
import signal
import sys
import time
from argparse import Namespace
from pathlib import Path
from typing import NoReturn

from .arguments import parse
from .errors import InputError
from .formats import FORMATS
from .output_file import check_writable, replacing

__all__ = ("main",)

PROGRAM = "cubic-craft"


def main(arguments: list[str] | None = None) -> int:
    """Do what the command line says, and return the exit code.

    Parameters
    ----------
    arguments : list of str, optional
        By default those of the process.
    """
    try:
        options = parse(sys.argv[1:] if arguments is None else arguments)
        _check_files(options.input, options.output)
        # So that the temporary file is removed where the process is told to end.
        signal.signal(signal.SIGTERM, _terminate)
        for line in _run(options):
            print(f"{PROGRAM}: {line}", file=sys.stderr)
    except InputError as error:
        print(f"{PROGRAM}: error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        _leave("interrupted", 130)
    except _Terminated:
        _leave("told to end", 143)
    return 0


class _Terminated(BaseException):
    """The process is told to end."""


def _terminate(*_: object) -> NoReturn:
    raise _Terminated


def _leave(words: str, code: int) -> NoReturn:
    """End at once: to free a factorisation that was interrupted may crash Python."""
    print(f"{PROGRAM}: {words}", file=sys.stderr, flush=True)
    os._exit(code)


def _check_files(source: Path, output: Path) -> None:
    for path in (source, output):
        if path.suffix.lower() not in FORMATS:
            kind = f"{path.suffix!r} files" if path.suffix else "files without a suffix"
            raise InputError(f"{path}: {kind} are not supported; give {', '.join(FORMATS)}")
    check_writable(output)
    if source.resolve() == output.resolve():
        raise InputError(f"{output}: this is the input; give another name")


def _run(options: Namespace) -> list[str]:
    """Read, stylize and write; return a summary, and notes."""
    # Late, because they take a while to import: --help and mistyped options need none.
    from . import mesh_files
    from .style import stylized

    begin = time.perf_counter()
    file = mesh_files.read(options.input)
    result = stylized(file.surface, options)
    with replacing(options.output) as temporary:
        try:
            notes = mesh_files.write(file, temporary, result.positions, result.rotations)
        except InputError as error:
            raise InputError(f"{options.output}: {error}") from None
    seconds = time.perf_counter() - begin
    end = "converged" if result.converged else "NOT converged"
    if result.crossings:
        end += f", {result.crossings} faces still cross"
    summary = (
        f"{options.output}: {len(file.surface.points)} vertices, {file.surface.face_count} faces, "
        f"{result.iterations} iterations, {end}, energy {result.energy.total:.5g}, "
        f"{result.device}, {seconds:.1f} s"
    )
    return [summary, *(f"note: {note}" for note in notes)]
