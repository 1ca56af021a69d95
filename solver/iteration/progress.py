# SPDX-License-Identifier: GPL-3.0-or-later
"""The progress of a run as one number, and a bar of it for terminals and notebooks."""

import math
import sys
from collections.abc import Callable, Generator
from contextlib import contextmanager

from .stylization import Stylization

_WIDTH = 30  # characters of a bar


class Progress:
    """Estimate the progress of a run from 0 to 1; the estimate never decreases.

    The displacement per iteration falls almost exponentially, so its logarithm, between the largest
    since the second iteration and the tolerance, is a better estimate than the number of
    iterations, whose end is not known. The first one moves much farther and says nothing.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import Progress, Setup, SolverOptions, Stylization, ball, rest_mesh, run
    >>> V, F = ball()
    >>> progress, shown = Progress(max_iterations=1000, tolerance=1e-3), []
    >>> options = SolverOptions(keep_rotation=True, device="numpy")
    >>> stylization = Stylization(Setup(rest_mesh(V, F)), 0.6, options=options)
    >>> _ = run(stylization, on_iteration=lambda state: shown.append(progress.update(state)))
    >>> [f"{shown[done - 1]:.2f}" for done in (1, 5, 10, 20)]  # iterations
    ['0.00', '0.35', '0.59', '0.86']
    """

    def __init__(self, max_iterations: int, tolerance: float):
        self._max_iterations = max_iterations
        self._tolerance = tolerance
        self._fraction = 0.0
        self._largest = 0.0

    def update(self, stylization: Stylization) -> float:
        """Record one iteration of a Stylization and return the fraction done.

        Those on coarser meshes do not count: they have an end of their own.
        """
        if stylization.is_coarse:
            return self._fraction
        fraction = stylization.iterations / self._max_iterations
        if stylization.iterations > 1 and stylization.distance > 0.0:
            relative = stylization.displacement / stylization.distance
            self._largest = max(self._largest, relative)
            if 0.0 < self._tolerance < self._largest and relative > 0.0:
                by_size = math.log(relative / self._largest)
                by_size /= math.log(self._tolerance / self._largest)
                if stylization.is_limited:  # the rest of the way is about as long
                    by_size *= 0.5
                fraction = max(fraction, min(by_size, 0.99))
        self._fraction = max(self._fraction, min(fraction, 1.0))
        return self._fraction


@contextmanager
def progress_bar(
    max_iterations: int, tolerance: float
) -> Generator[Callable[[Stylization], None], None, None]:
    """Give a function to call after each iteration, which draws a bar on standard error.

    The bar ends, full or not, with the block.
    """
    progress, shown = Progress(max_iterations, tolerance), ""

    def update(stylization: Stylization) -> None:
        nonlocal shown
        done = progress.update(stylization)
        bar = ("#" * round(_WIDTH * done)).ljust(_WIDTH, ".")
        line = f"\r{done:4.0%} [{bar}] iteration {stylization.iterations}"
        if line != shown and sys.stderr is not None:  # a program without a console has none
            shown = line
            sys.stderr.write(line)
            sys.stderr.flush()

    try:
        yield update
    finally:
        if shown:
            sys.stderr.write("\n")
