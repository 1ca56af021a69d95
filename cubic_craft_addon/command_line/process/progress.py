# SPDX-License-Identifier: GPL-3.0-or-later
"""Tell the terminal how far the run is: a bar where there is one, else a plain line per step.

Everything goes to standard error; standard output stays empty.
"""

import contextlib
import sys
from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec


class Task:
    """One step of the run, as `ProgressBar.task` gives it."""

    def __init__(self, show: Callable[..., None], escape: Callable[[str], str] = str) -> None:
        self._show, self._escape = show, escape
        self.summary = "done"

    def advance_to(self, fraction: float) -> None:
        """Show how much is done, from 0 to 1."""
        self._show(completed=fraction)

    def describe(self, title: str) -> None:
        """Show another title from now on."""
        self._show(description=self._escape(title))

    def finish(self, summary: str) -> None:
        """Set what the line says that remains of the step."""
        self.summary = summary


class ProgressBar:
    """Shows steps; with rich (which comes with Taichi and Quadrants) and a terminal as moving bars.

    What remains is estimated from the last 30 seconds.
    """

    @contextlib.contextmanager
    def task(self, title: str) -> Iterator[Task]:
        """Show one step while the block runs; one line of it remains."""
        if sys.stderr.isatty() and find_spec("rich"):
            from rich.console import Console
            from rich.markup import escape  # names may hold [brackets]
            from rich.progress import Progress

            console = Console(stderr=True)
            with Progress(console=console, transient=True, speed_estimate_period=30.0) as bar:
                task = Task(partial(bar.update, bar.add_task("", total=1.0)), escape)
                task.describe(title)
                yield task
        else:
            task = Task(lambda **_: None)
            yield task
        self.say(f"{title}: {task.summary}")

    def say(self, line: str) -> None:
        """Print one line."""
        # at once with its end: else a signal in between puts its own words into the same line
        print(f"{line}\n", end="", file=sys.stderr, flush=True)
