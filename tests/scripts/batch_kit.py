# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of batches share."""

import json
from pathlib import Path

from headless import headless_shared

CUBE = """o part
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
"""
QUICK = ("--device", "numpy", "--max-iterations", "2", "--refine", "off")
MESHES = (*QUICK, "--no-render", "--save-mesh", ".obj")


def batch(*arguments, cwd, options=MESHES):
    """Run a batch into the folder ``out``; return the completed process."""
    return headless_shared(*arguments, "--output-folder", "out", *options, cwd=cwd)


def files_in(folder):
    """Return the names of all files in a folder and below."""
    found = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    return sorted(path.as_posix() for path in found)


def statuses(folder):
    """Return {name of the input: status} from the report of a batch."""
    report = json.loads((folder / "report.json").read_text())
    return {Path(each["input"]).name: each["status"] for each in report["files"]}
