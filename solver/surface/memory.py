# SPDX-License-Identifier: GPL-3.0-or-later
"""Refuse meshes that would not fit into memory, before the machine runs out of it."""

import ctypes
import os
import sys
from pathlib import Path

from ..errors import CubicCraftError

BYTES_PER_VERTEX = 2700
"""peak of a run, measured on meshes of 245,000 and 405,000 vertices; smaller ones take less"""
_LINUX = Path("/proc/meminfo")


def check_memory(vertices, triangles):
    """Check that a run fits into the free memory; if that is unknown, nothing is refused.

    `vertices`, `triangles`: int, numbers of the mesh. Raises CubicCraftError: it does not fit; the
    message has the estimate, the free memory, and what to do.
    """
    # A closed mesh has two triangles for each vertex; what has more needs more.
    needed = BYTES_PER_VERTEX * max(vertices, triangles // 2)
    free = free_memory()
    if free is not None and needed > free:
        raise CubicCraftError(
            f"{vertices:,} vertices need about {_gigabytes(needed)} of memory, but only"
            f" {_gigabytes(free)} are free; close other programs, or take a smaller mesh"
            " (a Decimate modifier, applied, makes one)"
        )


def free_memory():
    """Return the bytes of memory that a program can take without swapping, or None if unknown.

    On macOS it is the memory of the whole machine, which is at least an upper bound.
    """
    try:
        return _free_memory()
    except (OSError, ValueError, KeyError, AttributeError):  # an unknown system
        return None


def _free_memory():
    if sys.platform == "win32":
        return _free_on_windows()
    if sys.platform == "linux":
        lines = _LINUX.read_text(encoding="ascii").splitlines()
        sizes = dict(line.split(":") for line in lines)
        return 1024 * int(sizes["MemAvailable"].split()[0])
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


class _MemoryStatus(ctypes.Structure):
    """MEMORYSTATUSEX of Windows, with the five fields that follow the free memory as one."""

    _fields_ = [
        ("dwLength", ctypes.c_uint32),
        ("dwMemoryLoad", ctypes.c_uint32),
        ("ullTotalPhys", ctypes.c_uint64),
        ("ullAvailPhys", ctypes.c_uint64),
        ("others", ctypes.c_uint64 * 5),
    ]


def _free_on_windows():
    status = _MemoryStatus(dwLength=ctypes.sizeof(_MemoryStatus))
    # By name: ctypes has windll on Windows only.
    if not getattr(ctypes, "windll").kernel32.GlobalMemoryStatusEx(ctypes.byref(status)):  # noqa: B009
        return None
    return status.ullAvailPhys


def _gigabytes(size):
    return f"{size / 1e9:,.1f} GB"
