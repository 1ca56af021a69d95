# SPDX-License-Identifier: GPL-3.0-or-later
"""From the start of a process to the first result; unless said, the kernels are on disk."""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ("monkey", "bpy", "solver")
"""functions of `first_result.py`"""


def startup(runs):
    """Return {program: seconds of each run}, run in alternation after one that does not count.

    Python's bytecode is kept, as Blender keeps it. ``clicks`` has what `first_result.click` prints
    with a new folder for the engine's kernels ("never") and with that of the run before ("again").
    """
    seconds = {name: [] for name in PROGRAMS}
    clicks = {"never": [], "again": []}
    search = os.pathsep.join([str(ROOT / "scripts"), str(ROOT)])
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": folder, "PYTHONPATH": search}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        for number in range(runs + 1):
            for name in PROGRAMS:
                begin = time.perf_counter()
                _run(name, environment)
                if number > 0:
                    seconds[name].append(time.perf_counter() - begin)
            kernels = environment | {"XDG_CACHE_HOME": str(Path(folder) / f"kernels{number}")}
            for figures in clicks.values():
                printed = json.loads(_run("click", kernels).splitlines()[-1])
                if number > 0:
                    figures.append(printed)
    return seconds | {"clicks": clicks}


def _run(name, environment):
    """Run a program of `first_result.py`; return what it prints."""
    program = f"from benchmark import first_result; first_result.{name}()"
    command = [sys.executable, "-c", program]
    run = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    return run.stdout
