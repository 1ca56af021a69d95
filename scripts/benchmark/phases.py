# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the time of one run goes, and the memory it takes."""

import functools
import threading
import time
from collections import Counter

from solver import stylization
from solver.backends.taichi_local_step import TaichiLocalStep
from solver.global_step import step as global_step

from . import our_solver
from .machine import peak_memory
from .meshes import read

PHASES = {
    "rest mesh": (our_solver, "rest_mesh"),
    "factorization": (global_step, "factorize"),
    "local step": (stylization.Stylization, "local_step"),
    "right-hand side": (TaichiLocalStep, "right_hand_side"),
    "solve": (global_step.GlobalStep, "positions"),
}
"""modules or classes, and their functions; none of them calls another"""


def put_under_clock(functions):
    """Replace functions, as in `PHASES`, by timed ones in this process; return {name: seconds}.

    The solver knows nothing of this.
    """
    seconds = Counter()

    def timed(phase, function):
        @functools.wraps(function)
        def run(*arguments, **options):
            begin = time.perf_counter()
            try:
                return function(*arguments, **options)
            finally:
                seconds[phase] += time.perf_counter() - begin

        return run

    for phase, (owner, name) in functions.items():
        setattr(owner, name, timed(phase, getattr(owner, name)))
    return seconds


class WhileAnyRuns:
    """The seconds in which any of some functions ran, as they may run beside each other.

    Parameters
    ----------
    functions : dict
        As `PHASES`. They are replaced in this process.

    Attributes
    ----------
    seconds : float
        May be set back to 0.
    """

    def __init__(self, functions):
        self.seconds = 0.0
        self._lock, self._running, self._begin = threading.Lock(), 0, 0.0
        for owner, name in functions.values():
            setattr(owner, name, self._timed(getattr(owner, name)))

    def _timed(self, function):
        @functools.wraps(function)
        def run(*arguments, **options):
            self._count(1)
            try:
                return function(*arguments, **options)
            finally:
                self._count(-1)

        return run

    def _count(self, change):
        with self._lock:
            now = time.perf_counter()
            if self._running:
                self.seconds += now - self._begin
            self._running, self._begin = self._running + change, now


def phases(path, cubeness):
    """Return the figures of `split`, the number of ``iterations``, and those of `peak_memory`."""
    our_solver.load_kernels()
    marks = []
    with peak_memory() as memory:
        seconds_of = put_under_clock(PHASES)

        def mark(seconds, *_):
            marks.append((seconds, {phase: seconds_of[phase] for phase in PHASES}))
            return seconds > our_solver.LIMIT_SECONDS

        our_solver.solve(*read(path), cubeness, mark)
    return {**split(marks), "iterations": len(marks), **memory}


def split(marks):
    """Split marks (seconds, {phase: seconds}), at least two, after each iteration.

    Returns
    -------
    dict
        ``setup`` {phase: seconds}, of all before the second iteration less one typical iteration;
        ``iteration`` {phase: milliseconds}, the mean of those after the first; both with what is
        left as "remainder".
    """
    (first, at_first), (last, at_last) = marks[0], marks[-1]
    count = len(marks) - 1
    iteration = {phase: (at_last[phase] - at_first[phase]) / count for phase in at_last}
    iteration["remainder"] = (last - first) / count - sum(iteration.values())
    setup = {phase: at_first[phase] - iteration[phase] for phase in at_last}
    setup["remainder"] = first - sum(at_first.values()) - iteration["remainder"]
    milliseconds = {phase: 1000 * seconds for phase, seconds in iteration.items()}
    return {"setup": setup, "iteration": milliseconds}
