# SPDX-License-Identifier: GPL-3.0-or-later
"""From the start of a process to the first result, the compiled kernels being on disk."""

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

    Python's bytecode is kept, as Blender keeps it.
    """
    seconds = {name: [] for name in PROGRAMS}
    search = os.pathsep.join([str(ROOT / "scripts"), str(ROOT)])
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": folder, "PYTHONPATH": search}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        for number in range(runs + 1):
            for name in PROGRAMS:
                program = f"from benchmark import first_result; first_result.{name}()"
                begin = time.perf_counter()
                command = [sys.executable, "-c", program]
                subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE)
                if number > 0:
                    seconds[name].append(time.perf_counter() - begin)
    return seconds
