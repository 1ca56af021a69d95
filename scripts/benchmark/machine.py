# SPDX-License-Identifier: GPL-3.0-or-later
"""The machine that is measured on, its processes and their memory."""

import multiprocessing
import platform
import re
import resource
import sys
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

import psutil

PACKAGES = ("numpy", "scipy", "taichi", "quadrants", "cholespy", "pymeshlab", "bpy")
_STATUS, _RESET = Path("/proc/self/status"), Path("/proc/self/clear_refs")


def machine_line():
    """Return one line about processor, system and versions."""
    cpuinfo = Path("/proc/cpuinfo")
    model = re.search(r"model name\s*: (.*)", cpuinfo.read_text() if cpuinfo.exists() else "")
    processor = f"{model[1]} ({platform.machine()})" if model else platform.machine()
    there = [name for name in PACKAGES if find_spec(name)]
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in there)
    return (
        f"{processor}, {psutil.cpu_count()} cores, {platform.system()},"
        f" Python {platform.python_version()}; {versions}."
    )


def isolated(function, **arguments):
    """Call a function in a process of its own, so that its memory and its start are its own too."""
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=spawn) as pool:
        return pool.submit(function, **arguments).result()


@contextmanager
def peak_memory():
    """Give a dict that has two numbers of bytes once the block has ended.

    They are the ``peak`` of this process in the block, and how much that is ``above`` what there
    was before. Other systems than Linux count the peak since the start of the process.
    """
    before, figures = psutil.Process().memory_info().rss, {}
    if _RESET.exists():
        _RESET.write_text("5")
    yield figures
    peak = _peak_bytes()
    figures |= {"peak": peak, "above": peak - before}


def _peak_bytes():
    if _STATUS.exists():  # what getrusage says on Linux cannot be reset
        return 1024 * int(re.findall(r"VmHWM:\s*(\d+)", _STATUS.read_text())[0])
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit
