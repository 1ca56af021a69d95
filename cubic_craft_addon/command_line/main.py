# SPDX-License-Identifier: GPL-3.0-or-later
"""The run of the command line, from its arguments to its exit code."""

import os
import sys
import time
from argparse import Namespace
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import NamedTuple

from ...solver.console.errors import InputError
from ...solver.console.interruption import before_ending, end_on_signals, end_with_input
from ...solver.console.temporary import remove_left_behind, replacing
from .batch.run import run_batch
from .options.arguments import parse
from .options.checks import refuse_empty
from .process.one_line import one_line
from .process.output_files import written
from .process.quiet import mute_stdout, terminal
from .process.version import version
from .process.watched_process import Limits, end_processes, finish, start, thread_variables


class Program(NamedTuple):
    """What somebody has started."""

    name: str
    """in its messages"""
    start: str
    """how it is started, for --help"""
    arguments: list[str]
    command: Callable[[int | None], list[str]]
    """gives what starts it once more, with so many threads (None for all)"""
    registered: Callable[[], AbstractContextManager[None]]
    """has the extension in Blender for a block; until then Blender need not have been started"""


def main_of(program: Program) -> int:
    """Do what the arguments of a program say, and return the exit code."""
    end_on_signals(program.name, terminal)
    begin = time.perf_counter()
    try:
        options = parse(program.arguments, program.start)
        if options.worker or options.limited:
            end_with_input()
        mute_stdout(options.verbose)
        if options.output_folder:
            return run_batch(options, program.command, version(), program.name)
        return _run_one(options, program, begin)
    except InputError as error:
        print(f"{program.name}: error: {one_line(str(error))}", file=sys.stderr)
        return 2


def _run_one(options: Namespace, program: Program, begin: float) -> int:
    """Run with one file, or the monkey; with --error-file say there why it cannot be used.

    Returns the exit code.
    """
    try:
        if options.input is not None:
            refuse_empty(options.input)
        if (options.timeout or options.memory) and not options.limited:
            return _run_limited(options, program)
        os.environ.update(thread_variables(options.threads))
        with program.registered():
            # Late, because it takes Blender a second to start.
            from .pipeline import run

            run(options, begin)
        if options.error_file:
            options.error_file.unlink(missing_ok=True)
    except InputError as error:
        if not options.error_file:
            raise
        print(f"{program.name}: {one_line(str(error))}", file=sys.stderr)
        with replacing(options.error_file) as temporary:
            temporary.write_text(f"{error}\n", encoding="utf-8")
    return 0


def _run_limited(options: Namespace, program: Program) -> int:
    """Run with one file in another process, and return its exit code.

    Raises InputError: it has exceeded a limit.
    """
    before_ending(end_processes)
    process = start([*program.command(options.threads), *program.arguments, "--limited"])
    exceeded, _ = finish(process, Limits(options.timeout, options.memory))
    outputs = written(options.output, options.save_mesh, options)
    for path in (*outputs, options.bake, options.report):
        if path is not None:
            remove_left_behind(path)
    if exceeded:
        raise InputError(f"{options.input or 'monkey'}: {exceeded}")
    code = process.returncode
    return code if code >= 0 else 128 - code
