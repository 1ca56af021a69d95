# SPDX-License-Identifier: GPL-3.0-or-later
"""From the start of a process to the first result, the compiled kernels being on disk."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from .isolated import ROOT, SCRIPTS

FOLDER = Path(__file__).parent
PROGRAMS = {
    "monkey": ("first_result_blender.py", SCRIPTS, ROOT),
    "bpy": ("first_import_bpy.py",),
    "solver": ("first_result_solver.py", ROOT),
}


def startup(runs):
    """Return {program: seconds of each run}, run in alternation after one that does not count.

    The programs are "monkey" (bpy, the extension and its first Cubify), "bpy" (its import alone)
    and "solver" (first result without Blender). Python's bytecode is kept, as Blender keeps it.
    """
    seconds = {name: [] for name in PROGRAMS}
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": folder}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        for number in range(runs + 1):
            for name, command in PROGRAMS.items():
                elapsed = _seconds_until_done(environment, *command)
                if number > 0:
                    seconds[name].append(elapsed)
    return seconds


def _seconds_until_done(environment, program, *arguments):
    begin = time.time()  # the clock that two processes share
    process = subprocess.run(
        [sys.executable, str(FOLDER / program), *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
        env=environment,
    )
    for line in process.stdout.splitlines():
        if line.startswith("done at "):
            return float(line.removeprefix("done at ")) - begin
    raise RuntimeError(f"{program} failed:\n{process.stderr.strip()[-2000:]}")
