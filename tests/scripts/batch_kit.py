"""What the tests of batches share."""

import json
import os
import subprocess
import time
from pathlib import Path

from headless import PATIENCE, headless, start_headless

CUBE = """o part
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
"""
QUICK = ("--device", "numpy", "--max-iterations", "2")
MESHES = (*QUICK, "--no-render", "--save-mesh", ".obj")


def batch(*arguments, cwd, options=MESHES):
    """Run a batch into the folder ``out``; return the completed process."""
    return headless(*arguments, "--output-folder", "out", *options, cwd=cwd)


def start(*arguments, cwd, options=MESHES):
    """Start a batch into the folder ``out``."""
    return start_headless(*arguments, "--output-folder", "out", *options, cwd=cwd)


def children(process):
    """Return the numbers of the processes that a process has started."""
    listing = subprocess.run(
        ["ps", "-A", "-o", "pid=,ppid="], check=True, capture_output=True, text=True
    )
    pairs = [line.split() for line in listing.stdout.splitlines()]
    return [int(child) for child, parent in pairs if int(parent) == process.pid]


def wait_for_children(process, count=1):
    """Wait until there are so many, and return their numbers."""
    end = time.monotonic() + PATIENCE
    while len(found := children(process)) < count:
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < end, "no worker is started"
    return found


def is_there(number):
    """Return whether a process still runs."""
    try:
        os.kill(number, 0)
    except ProcessLookupError:
        return False
    return True


def files_in(folder):
    """Return the names of all files in a folder and below, but for the records of batches."""
    found = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    return sorted(path.as_posix() for path in found if ".cubic_craft" not in path.parts)


def statuses(folder):
    """Return {name of the input: status} from the report of a batch."""
    report = json.loads((folder / "report.json").read_text())
    return {Path(each["input"]).name: each["status"] for each in report["files"]}
