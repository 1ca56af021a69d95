# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes that end with this one, and within limits of time and memory.

The standard input of each is a pipe. It ends when the process at the other end is gone for whatever
reason, or closes it: that is how it is told to end, everywhere (`interruption.end_with_input`).
"""

import contextlib
import subprocess
import threading
import time
from typing import Any, NamedTuple

from ....solver.console.process_memory import GIGABYTE, memory_of, peak_gb

PATIENCE = 10.0
"""seconds in which a process tidies up before it is killed"""
IMPATIENCE = 1.0
"""the same for one that takes more and more memory"""
INTERVAL = 0.2
"""seconds between two looks at a process"""
_VARIABLES = (
    *("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"),
    *("VECLIB_MAXIMUM_THREADS", "TI_CPU_MAX_NUM_THREADS", "QD_CPU_MAX_NUM_THREADS"),
)
_ending = threading.Lock()
_running: set[subprocess.Popen] = set()


class Limits(NamedTuple):
    """What a process may take; None is no limit."""

    timeout: float | None = None
    """seconds"""
    memory: float | None = None
    """gigabytes, of it and the processes that it starts"""


def thread_variables(count: int | None) -> dict[str, str]:
    """Return what in a process's environment keeps its numerical libraries to so many threads.

    Nothing for None. Cycles has a setting of its own.
    """
    return dict.fromkeys(_VARIABLES, str(count)) if count else {}


def start(command: list[str], **how: Any) -> subprocess.Popen:
    """Start a process; ``how`` is for `subprocess.Popen`."""
    with _ending:  # or one that is being started would be left behind
        process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,  # Ctrl-C is for us, who then end it
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
            **how,
        )
        _running.add(process)
    return process


def finish(process: subprocess.Popen, limits: Limits) -> tuple[str, float | None]:
    """Wait for the end of a process.

    Returns in words the limit that it has exceeded, if any; and the most gigabytes that it was seen
    to have had in memory, if known.
    """
    begin, exceeded, peak = time.monotonic(), "", None
    while process.returncode is None:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(INTERVAL)
        if process.returncode is not None:
            break
        peak = peak_gb(process.pid) or peak
        if limits.memory and memory_of(process.pid) > limits.memory * GIGABYTE:
            exceeded = exceeded or f"takes more than {limits.memory:g} GB (--memory)"
            _end(process, IMPATIENCE)
        elif limits.timeout and time.monotonic() - begin > limits.timeout:
            exceeded = exceeded or f"takes longer than {limits.timeout:g} seconds (--timeout)"
            _end(process)
    with _ending:
        _running.discard(process)
    return exceeded, peak


def end_processes() -> None:
    """End all that run, and wait until they are gone; nothing more is said of them."""
    _ending.acquire()
    for process in _running:
        process.stdin.close()
    for process in _running:
        _end(process)


def _end(process: subprocess.Popen, patience: float = PATIENCE) -> None:
    process.stdin.close()
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(patience)
    process.kill()
