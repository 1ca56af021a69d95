# SPDX-License-Identifier: GPL-3.0-or-later
"""Tell the terminal how far the run is: a bar where there is one, else a plain line per step.

Everything goes to standard error; standard output stays empty.
"""

import contextlib
import sys
from collections.abc import Iterator
from typing import Any

__all__ = ("ProgressBar", "Task")


class Task:
    """One step of the run, as `ProgressBar.task` gives it."""

    def __init__(self, bar: Any = None, number: Any = None, escape: Any = None) -> None:
        self._bar, self._number, self._escape = bar, number, escape
        self.summary = "done"

    def advance_to(self, fraction: float) -> None:
        """Show how much is done, from 0 to 1."""
        if self._bar is not None:
            self._bar.update(self._number, completed=fraction)

    def describe(self, title: str) -> None:
        """Show another title from now on."""
        if self._bar is not None:
            self._bar.update(self._number, description=self._escape(title))

    def finish(self, summary: str) -> None:
        """Set what the line says that remains of the step."""
        self.summary = summary


class ProgressBar:
    """Shows steps; with rich (which comes with Taichi) and a terminal as moving bars.

    A silent one says only what must be read.
    """

    def __init__(self, is_silent: bool = False, memory: float = 30.0) -> None:
        """Prepare.

        Parameters
        ----------
        memory : seconds of the past from which the time that remains is estimated
        """
        self._is_silent = is_silent
        self._memory = memory
        self._rich = None
        if sys.stderr.isatty():
            with contextlib.suppress(ImportError):
                import rich.console
                import rich.markup
                import rich.progress

                self._rich = rich

    @contextlib.contextmanager
    def task(self, title: str) -> Iterator[Task]:
        """Show one step while the block runs; one line of it remains."""
        if self._rich is None:
            task = Task()
            yield task
        else:
            console = self._rich.console.Console(stderr=True)
            escape = self._rich.markup.escape  # names may hold [brackets]
            with self._rich.progress.Progress(
                console=console, transient=True, speed_estimate_period=self._memory
            ) as bar:
                task = Task(bar, bar.add_task(escape(title), total=1.0), escape)
                yield task
        self.say(f"{title}: {task.summary}")

    def say(self, line: str) -> None:
        """Print one line about how far the run is."""
        if not self._is_silent:
            self.warn(line)

    def warn(self, line: str) -> None:
        """Print one line that must be read."""
        print(line, file=sys.stderr, flush=True)
