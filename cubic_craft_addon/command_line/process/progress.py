# SPDX-License-Identifier: GPL-3.0-or-later
"""Tell the terminal how far the run is: a line that changes where there is one, and one that stays.

Everything goes to standard error; standard output stays empty.
"""

import contextlib
import shutil
import sys
from collections.abc import Iterator


class Task:
    """One step of the run, as `task` gives it; `summary` is what its line says in the end."""

    def __init__(self, title: str) -> None:
        self.title, self.summary = title, "done"

    def show(self, progress: str) -> None:
        """Show how much is done, in words."""
        _overwrite(f"{self.title}: {progress}")


@contextlib.contextmanager
def task(title: str) -> Iterator[Task]:
    """Show one step while the block runs; one line of it remains."""
    _overwrite(title)
    shown = Task(title)
    try:
        yield shown
    finally:
        _overwrite("")
    say(f"{title}: {shown.summary}")


def _overwrite(line: str) -> None:
    if sys.stderr.isatty():
        width = shutil.get_terminal_size().columns - 1
        print(f"\r{line[:width].ljust(width)}\r", end="", file=sys.stderr, flush=True)


def say(line: str) -> None:
    """Print one line."""
    # at once with its end: else a signal in between puts its own words into the same line
    print(f"{line}\n", end="", file=sys.stderr, flush=True)
