# SPDX-License-Identifier: GPL-3.0-or-later
"""A progress bar on standard error, for terminals and notebooks."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from .progress import Progress
from .stylization import Stylization

WIDTH = 30
"""characters"""


@contextmanager
def progress_bar(max_iterations: int, tolerance: float) -> Iterator[Callable[[Stylization], None]]:
    """Give a function to call after each iteration; the bar ends, full or not, with the block."""
    progress, shown = Progress(max_iterations, tolerance), ""

    def update(stylization: Stylization) -> None:
        nonlocal shown
        done = progress.update(stylization)
        bar = ("#" * round(WIDTH * done)).ljust(WIDTH, ".")
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
