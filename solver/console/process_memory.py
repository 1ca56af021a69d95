# SPDX-License-Identifier: GPL-3.0-or-later
"""How much memory a process has, and has had at most, on each system."""

import contextlib
import ctypes
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

GIGABYTE = 1e9


def memory_of(number: int) -> int:
    """Return the bytes that a process that was started here has in memory; 0 if unknown."""
    with contextlib.suppress(OSError, ValueError, subprocess.SubprocessError):
        if sys.platform == "linux":
            return _memory_of_group(number)
        if sys.platform == "win32":
            return _on_windows(number).working_set
        words = subprocess.run(["ps", "-A", "-o", "pgid=,rss="], capture_output=True, check=True)
        rows = (map(int, line.split()) for line in words.stdout.splitlines())
        return 1024 * sum(size for group, size in rows if group == number)
    return 0


def peak_gb(number: int | None = None) -> float | None:
    """Return the most gigabytes that a process that runs has had in memory; None if unknown.

    `number`: of the process; None is this one.
    """
    with contextlib.suppress(OSError, ValueError, IndexError):
        if sys.platform == "linux":  # where the figure of `resource` is that of the parent, too
            place = Path(f"/proc/{number or 'self'}/status")
            text = place.read_text(encoding="ascii", errors="replace")
            return round(1024 * int(text.split("VmHWM:")[1].split()[0]) / GIGABYTE, 3)
        if sys.platform == "win32":
            return round(_on_windows(number or os.getpid()).peak / GIGABYTE, 3)
        if number is None:
            import resource

            return round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / GIGABYTE, 3)
    return None


def _memory_of_group(number: int) -> int:
    """Return the memory of all processes that a process leads, as a launcher starts Blender."""
    pages = 0
    for place in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it has just ended
            words = place.read_text(errors="replace").rpartition(")")[2].split()
            pages += int(words[21]) if int(words[2]) == number else 0
    return pages * os.sysconf("SC_PAGE_SIZE")


def _on_windows(number: int) -> Any:
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
    return counters
