# SPDX-License-Identifier: GPL-3.0-or-later
"""Code that runs in a process of its own, because the program of an engine is global."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

from engine_marks import CPU

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
SET_UP = """
import sys
sys.path.insert(0, {root!r})
sys.path.insert(0, {here!r})
from functools import partial
import numpy as np
import shapes
import solver
from solver import PAPER
stylize = partial(solver.stylize, proxy=PAPER)
CPU = {cpu!r}
V, F = shapes.blob(2)
"""


def python(code, **environment):
    code = SET_UP.format(root=str(ROOT), here=str(HERE), cpu=CPU) + textwrap.dedent(code)
    return subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        timeout=300,
    )


def passes(code, **environment):
    run = python(code, **environment)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout
