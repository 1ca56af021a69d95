# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes that end with this one, and within limits of time and memory.

The standard input of each is a pipe. It ends when the process at the other end is gone for whatever
reason, or closes it: that is how it is told to end, everywhere (`interruption.end_with_input`).
"""

import contextlib
import ctypes
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ("Limits", "end_processes", "finish", "start")

PATIENCE = 10.0
"""seconds in which a process tidies up before it is killed"""
IMPATIENCE = 1.0
"""the same for one that takes more and more memory"""
INTERVAL = 0.2
"""seconds between two looks at a process"""
GIGABYTE = 1e9
_ending = threading.Lock()
_running: set[subprocess.Popen] = set()


class Limits(NamedTuple):
    """What a process may take; None is no limit."""

    timeout: float | None = None
    """seconds"""
    memory: float | None = None
    """gigabytes, of it and the processes that it starts"""


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


def finish(
    process: subprocess.Popen, limits: Limits, is_wanted: Callable[[], bool] = lambda: True
) -> str:
    """Wait for the end of a process; return in words the limit that it has exceeded, if any.

    Parameters
    ----------
    is_wanted : asked now and then; when it is not, the process is ended
    """
    begin, exceeded = time.monotonic(), ""
    while process.returncode is None:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(INTERVAL)
        if process.returncode is not None:
            break
        if limits.memory and _memory_of(process.pid) > limits.memory * GIGABYTE:
            exceeded = exceeded or f"takes more than {limits.memory:g} GB (--memory)"
            _end(process, IMPATIENCE)
        elif limits.timeout and time.monotonic() - begin > limits.timeout:
            exceeded = exceeded or f"takes longer than {limits.timeout:g} seconds (--timeout)"
            _end(process)
        elif not is_wanted():
            _end(process)
    with _ending:
        _running.discard(process)
    return exceeded


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


def _memory_of(number: int) -> int:
    """Return the bytes that a process that was started here has in memory; 0 if unknown."""
    with contextlib.suppress(OSError, ValueError, subprocess.SubprocessError):
        if sys.platform == "linux":
            return _memory_of_group(number)
        if sys.platform == "win32":
            return _memory_on_windows(number)
        words = subprocess.run(["ps", "-A", "-o", "pgid=,rss="], capture_output=True, check=True)
        rows = (map(int, line.split()) for line in words.stdout.splitlines())
        return 1024 * sum(size for group, size in rows if group == number)
    return 0


def _memory_of_group(number: int) -> int:
    """Return the memory of all processes that a process leads, as a launcher starts Blender."""
    pages = 0
    for place in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it has just ended
            words = place.read_text(errors="replace").rpartition(")")[2].split()
            pages += int(words[21]) if int(words[2]) == number else 0
    return pages * os.sysconf("SC_PAGE_SIZE")


def _memory_on_windows(number: int) -> int:
    class Counters(ctypes.Structure):
        _fields_ = [
            *(("size", ctypes.c_uint32), ("faults", ctypes.c_uint32)),
            *((name, ctypes.c_size_t) for name in ("peak", "working_set", "a", "b", "c", "d")),
            *((name, ctypes.c_size_t) for name in ("pagefile", "peak_pagefile")),
        ]

    windows = ctypes.WinDLL("kernel32")  # pyright: ignore[reportAttributeAccessIssue]
    windows.OpenProcess.restype = ctypes.c_void_p
    limited_information = 0x1000
    handle = ctypes.c_void_p(windows.OpenProcess(limited_information, False, number))
    counters = Counters(size=ctypes.sizeof(Counters))
    windows.K32GetProcessMemoryInfo(handle, ctypes.byref(counters), counters.size)
    windows.CloseHandle(handle)
    return counters.working_set
