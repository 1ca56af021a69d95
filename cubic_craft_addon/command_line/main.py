# SPDX-License-Identifier: GPL-3.0-or-later
"""The run of the command line, from its arguments to its exit code."""

import os
import sys
import time
from argparse import Namespace
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import NamedTuple

from ...solver.console.interruption import end_on_signals, end_with_input
from ...solver.console.output import InputError
from .batch.run import run_batch
from .options.arguments import parse
from .options.checks import refuse_empty
from .process.child import CRASHING, run_child, thread_variables
from .process.output_files import written
from .process.quiet import mute_stdout, one_line, terminal


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
        if options.worker or options.child:
            end_with_input()
        mute_stdout(options.verbose)
        if options.output_folder:
            return run_batch(options, program.arguments, program.command, program.name)
        return _run_one(options, program, begin)
    except InputError as error:
        print(f"{program.name}: error: {one_line(str(error))}", file=sys.stderr)
        return 2


def _run_one(options: Namespace, program: Program, begin: float) -> int:
    if options.input is not None:
        refuse_empty(options.input)
    if not (options.worker or options.child) and (options.timeout or _may_crash(options)):
        return _run_child(options, program)
    os.environ.update(thread_variables(options.threads))
    with program.registered():
        # Late, because it takes Blender a second to start.
        from .pipeline import run

        run(options, begin)
    return 0


def _may_crash(options: Namespace) -> bool:
    paths = (options.input, options.form_object, options.capture)
    return any(path.suffix.lower() in CRASHING for path in paths if path)


def _run_child(options: Namespace, program: Program) -> int:
    """Run with one file in another process, and return its exit code.

    Raises InputError: it has crashed, or takes too long.
    """
    command = [*program.command(options.threads), *program.arguments, "--child"]
    outputs = written(options) + ([options.report] if options.report else [])
    code, words = run_child(command, options.timeout, outputs)
    if words:
        raise InputError(f"{options.input or 'monkey'}: {words}")
    return code
