# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the solver under a clock, and judge shapes, whoever made them."""

import math
import time
from dataclasses import dataclass

import numpy as np

from solver import PAPER, Setup, Stylization, rest_mesh, run

from .primitives import blob

EVALUATION_STEPS = 30
"""local steps that evaluate the energy of a given shape"""


@dataclass(frozen=True)
class Run:
    """One run from the arrays of the mesh to the result. Times do not hold loading of kernels."""

    setup: Setup
    setup_seconds: float
    """until the first iteration begins"""
    seconds: float
    iterations: int
    reason: str
    positions: np.ndarray
    """(n,3)"""
    curve: list
    """[seconds since the beginning, energy] after each iteration"""

    def figures(self):
        """Return what is worth keeping, as JSON can hold it."""
        return {
            "setup": self.setup_seconds,
            "seconds": self.seconds,
            "iterations": self.iterations,
            "reason": self.reason,
            "curve": self.curve,
        }


def solve(
    V, F, cubeness, is_over=None, is_accelerated=True, proxy=PAPER, keep_rotation=False, **stop
):
    """Stylize a mesh and return the Run; unless settings are given, as in the paper.

    The energy noted after an iteration is that of the shape that its local step looked at, so it
    lags behind by one iteration.

    Parameters
    ----------
    V : (n,3) array
    F : (m,3) array
    cubeness : float
    is_over : callable, optional
        Ends the run early when it returns true for (seconds, energy, iteration).
    is_accelerated, keep_rotation : bool
        See `Stylization`.
    proxy : ProxyOptions
        See `solver.rest_mesh`.
    **stop
        max_iterations and tolerance, see `solver.run`.
    """
    curve = []
    begin = time.perf_counter()
    setup = Setup(rest_mesh(V, F, proxy))
    options = {"is_accelerated": is_accelerated, "keep_rotation": keep_rotation}
    stylization = Stylization(setup, cubeness, **options)
    compiling = stylization.compile_seconds
    setup_seconds = time.perf_counter() - begin - compiling

    def note(state):
        seconds = time.perf_counter() - begin - compiling
        curve.append([seconds, state.energy.total])
        return is_over is not None and is_over(seconds, state.energy.total, state.iteration)

    result = run(stylization, on_iteration=note, **stop)
    seconds = time.perf_counter() - begin - compiling
    return Run(
        setup, setup_seconds, seconds, result.iterations, result.reason, result.positions, curve
    )


def over(seconds, energy=-math.inf):
    """Return an `is_over` for `solve`: after these seconds, or once down at this energy."""
    return lambda elapsed, reached, _: elapsed > seconds or reached <= energy


def energy_of(setup, cubeness, positions):
    """Return the energy of a shape (n,3) in the unit box, with the rotations that fit it best.

    Each vertex has several minima. Looked for from the rest shape and from the rotations that fit
    best without cubeness, whichever ends lower: of a million vertices, the first alone finds 1.4 %
    more energy than the run had itself.
    """
    fit = Stylization(setup, 0.0, is_accelerated=False)
    fit.energy_of(positions, 1)
    from_fit = Stylization(setup, cubeness, is_accelerated=False)
    from_fit.start_from(fit.rotations, fit.positions)
    from_rest = Stylization(setup, cubeness, is_accelerated=False)
    return min(
        judge.energy_of(positions, EVALUATION_STEPS).total for judge in (from_fit, from_rest)
    )


def load_kernels():
    """Solve something, so that nothing has to be imported, compiled or loaded in what follows."""
    solve(*blob(3), 0.4, max_iterations=3)
