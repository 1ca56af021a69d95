# SPDX-License-Identifier: GPL-3.0-or-later
"""Let any function of the extension fail, found by running it: no list of them to keep.

`places` runs an operator and notes every function of our own that is called from its `execute`.
`failing` lets one of them raise when it is entered. Both use Python's profiling hook, so nothing is
patched, and functions that were imported by name fail like all others.
"""

import contextlib
import inspect
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True)
class Place:
    """A function of the extension."""

    file: str
    name: str
    line: int

    def __str__(self):
        return f"{self.file}:{self.line} {self.name}"


def places(run, folder, *, in_operator=True):
    """Return the functions below a folder that an operator calls, and how often: {Place: int}.

    Without `in_operator` those are meant that are called in any way.
    """
    found = {}

    def note(place):
        found[place] = found.get(place, 0) + 1

    with _watching(folder, note, in_operator):
        run()
    return found


@contextlib.contextmanager
def failing(place, error, folder, call=1, *, in_operator=True):
    """Let a function raise `error` when it is entered for the given time, as in `places`.

    Yields a list that holds the place once it has raised.
    """
    raised = []
    entered = 0

    def fail(now):
        nonlocal entered
        entered += now == place
        if now == place and entered == call:
            sys.setprofile(None)
            raised.append(place)
            raise error

    with _watching(folder, fail, in_operator):
        yield raised


@contextlib.contextmanager
def _watching(folder, on_call, in_operator):
    """Call `on_call(place)` for each call of a function below the folder, or those in `execute`.

    Of generators only for their begin: raising where one goes on would skip what it puts back, as
    no exception of the real world does.
    """
    execute = None
    begun = set()  # the frames themselves, so that no new one takes the number of an old one

    def watch(frame, event, _):
        nonlocal execute
        if event == "return" and frame is execute:
            execute = None
        code = frame.f_code
        if event != "call" or not code.co_filename.startswith(folder):
            return
        if in_operator and execute is None:
            if code.co_qualname.endswith(".execute"):
                execute = frame
            return
        if code.co_flags & inspect.CO_GENERATOR:
            if frame in begun:
                return
            begun.add(frame)
        on_call(_place(code, folder))

    sys.setprofile(watch)
    try:
        yield
    finally:
        sys.setprofile(None)


@cache
def _place(code, folder):
    file = Path(code.co_filename).relative_to(folder).as_posix()
    return Place(file, code.co_qualname, code.co_firstlineno)
