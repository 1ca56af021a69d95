# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the time of one run goes, and the memory it takes.

The solver knows nothing of this: its functions are replaced by timed ones, in this process.
"""

import functools
import importlib
import sys
import time

from . import memory
from .meshes import read
from .our_solver import load_kernels, over, solve

LIMIT_SECONDS = 120.0
"""after which the run is given up"""

PHASES = {
    "rest mesh": ("benchmark.our_solver", "rest_mesh"),
    "factorisation": ("solver.global_step", "factorize"),
    "local step": ("solver.stylization", "Stylization.local_step"),
    "right-hand side": ("solver.backends.taichi_local_step", "TaichiLocalStep.right_hand_side"),
    "solve": ("solver.global_step", "GlobalStep.positions"),
}
"""where in the solver each phase is"""


class Stopwatch:
    """Adds up the time of each phase, without that of the phases that it calls."""

    def __init__(self):
        self.seconds = {}
        self._inside = []

    def timed(self, phase, function):
        """Return the function under the clock."""
        self.seconds[phase] = 0.0

        @functools.wraps(function)
        def run(*arguments, **options):
            self._inside.append(0.0)
            begin = time.perf_counter()
            try:
                return function(*arguments, **options)
            finally:
                elapsed = time.perf_counter() - begin
                self.seconds[phase] += elapsed - self._inside.pop()
                if self._inside:
                    self._inside[-1] += elapsed

        return run

    def replace(self, phase, module, path):
        """Put a function of a module, or a method, under the clock where everyone finds it."""
        *owners, name = path.split(".")
        owner = functools.reduce(getattr, owners, importlib.import_module(module))
        setattr(owner, name, self.timed(phase, getattr(owner, name)))


def phases(path, cubeness):
    """Return seconds of set-up and milliseconds per iteration by phase, and bytes of memory.

    Returns
    -------
    dict
        ``setup`` {phase: seconds}, of all before the second iteration less one typical iteration;
        ``iteration`` {phase: milliseconds}, the mean of those after the first; both with what is
        left as "remainder"; ``iterations``; ``peak`` bytes of the process, and ``above`` bytes
        more than before the mesh was read.
    """
    load_kernels()
    before = memory.resident_bytes()
    memory.reset_peak()
    watch = Stopwatch()
    for phase, (module, name) in PHASES.items():
        try:
            watch.replace(phase, module, name)
        except AttributeError:
            print(f"{module}.{name} is no more: {phase} not timed", file=sys.stderr)
    marks = []  # after each iteration: seconds since the beginning, {phase: seconds}

    is_over = over(LIMIT_SECONDS)

    def mark(seconds, energy, iteration):
        marks.append((seconds, dict(watch.seconds)))
        return is_over(seconds, energy, iteration)

    V, F = read(path)
    solve(V, F, cubeness, mark)
    peak = memory.peak_bytes()
    return {
        **split(marks),
        "iterations": len(marks),
        "peak": peak,
        "above": peak - before,
    }


def split(marks):
    """Split marks (seconds, {phase: seconds}) after each iteration into set-up and iteration.

    Raises
    ------
    ValueError
        There are fewer than two marks.
    """
    if len(marks) < 2:
        raise ValueError(f"the run must have at least two iterations, not {len(marks)}")
    (first, at_first), (last, at_last) = marks[0], marks[-1]
    count = len(marks) - 1
    iteration = {phase: (at_last[phase] - at_first[phase]) / count for phase in at_last}
    iteration["remainder"] = (last - first) / count - sum(iteration.values())
    setup = {phase: at_first[phase] - iteration[phase] for phase in at_last}
    setup["remainder"] = first - sum(at_first.values()) - iteration["remainder"]
    return {
        "setup": setup,
        "iteration": {phase: 1000 * seconds for phase, seconds in iteration.items()},
    }
