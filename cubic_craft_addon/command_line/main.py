# SPDX-License-Identifier: GPL-3.0-or-later
"""The run of the command line, from its arguments to its exit code."""

import contextlib
import sys
import time
from collections.abc import Callable
from contextlib import AbstractContextManager

from ...solver.console.interruption import end_on_signals
from ...solver.console.output import InputError
from .batch import jobs_of, run_batch
from .options.arguments import parse
from .process.quiet import mute_stdout, one_line, terminal


def main_of(
    arguments: list[str],
    program: str,
    start: str,
    registered: Callable[[], AbstractContextManager[None]] = contextlib.nullcontext,
) -> int:
    """Do what the arguments of a program say, and return the exit code.

    `program`: its name in messages. `start`: how it is started, for --help. `registered`: has the
    extension in Blender for a block; until then Blender need not have been started.
    """
    end_on_signals(program, terminal)
    begin = time.perf_counter()

    def complain(line: str) -> None:
        print(f"{program}: {one_line(line)}", file=sys.stderr, flush=True)

    try:
        options = parse(arguments, start)
        mute_stdout(options.verbose)
        jobs = jobs_of(options) if options.output_folder else []
        with registered():
            # Late, because it takes Blender a second to start.
            from .pipeline import run

            if jobs:
                return run_batch(jobs, options, run, complain)
            run(options, begin)
    except InputError as error:
        complain(f"error: {error}")
        return 2
    return 0
