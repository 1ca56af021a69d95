# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of batches share."""

import contextlib
import json
import os
import time
from pathlib import Path

import psutil
from headless import PATIENCE, headless, processor_seconds, start_headless

CUBE = """o part
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
"""
QUICK = ("--device", "numpy", "--max-iterations", "2", "--refine", "off")
ENDLESS = (
    *("--device", "numpy", "--no-render", "--save-mesh", ".obj"),
    *("--tolerance", "1e-12", "--max-iterations", "1000000", "--cubeness", "1"),
)
"""for meshes of some size, such as `waves`"""
MESHES = (*QUICK, "--no-render", "--save-mesh", ".obj")


def batch(*arguments, cwd, options=MESHES):
    """Run a batch into the folder ``out``; return the completed process."""
    return headless(*arguments, "--output-folder", "out", *options, cwd=cwd)


def start(*arguments, cwd, options=MESHES):
    """Start a batch into the folder ``out``."""
    return start_headless(*arguments, "--output-folder", "out", *options, cwd=cwd)


def files_of(process):
    """Return the numbers of the processes that do a file each, for a batch or for workers."""
    found = []
    with contextlib.suppress(psutil.NoSuchProcess):
        for each in psutil.Process(process.pid).children(recursive=True):
            with contextlib.suppress(psutil.NoSuchProcess):
                if any(word.startswith("--worker=") for word in each.cmdline()):
                    found.append(each.pid)
    return found


def wait_for_files(process, count=1):
    """Wait until so many are being done, and return the numbers of their processes."""
    end = time.monotonic() + PATIENCE
    while len(found := files_of(process)) < count:
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < end, "no file is begun"
        time.sleep(0.02)
    return found


def wait_until_they_solve(numbers):
    """Wait until processes have used more of the processor than Blender's start takes."""
    end = time.monotonic() + PATIENCE
    for number in numbers:
        while processor_seconds(number) < 2.0:
            assert time.monotonic() < end
            time.sleep(0.1)


def is_there(number):
    """Return whether a process still runs."""
    try:
        os.kill(number, 0)
    except ProcessLookupError:
        return False
    return True


def wait_until_gone(numbers, seconds=PATIENCE):
    """Wait until none of these processes runs any more."""
    end = time.monotonic() + seconds
    while any(map(is_there, numbers)):
        assert time.monotonic() < end, "a worker goes on without its batch"
        time.sleep(0.05)


def files_in(folder):
    """Return the names of all files in a folder and below, but for the records of batches."""
    found = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    return sorted(path.as_posix() for path in found if ".cubic_craft" not in path.parts)


def statuses(folder):
    """Return {name of the input: status} from the report of a batch."""
    report = json.loads((folder / "report.json").read_text())
    return {Path(each["input"]).name: each["status"] for each in report["files"]}


def waves(size):
    """Return an .obj with a wavy sheet; of 200 x 200, the solver is busy for minutes with it."""
    points = [f"v {x} {y} {(x * 7 + y * 13) % 10}" for y in range(size) for x in range(size)]
    corners = [y * size + x + 1 for y in range(size - 1) for x in range(size - 1)]
    faces = [f"f {c} {c + 1} {c + size + 1} {c + size}" for c in corners]
    return "\n".join([*points, *faces]) + "\n"
