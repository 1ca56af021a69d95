# SPDX-License-Identifier: GPL-3.0-or-later
"""One user of the engine at a time: a process has its program, modules and threads only once.

It may be used from any thread, but it is not made for two at once, and what we replace for the time
of its import is replaced for all threads. So whatever touches it holds `LOCK`.
A fork waits until nobody does. The child has the engine's program, but none of its threads, and
would wait for them for ever: see `check_not_forked`.
"""

import ctypes
import functools
import os
import threading

from ..errors import CubicCraftError
from .engine_choice import engine, started_program

LOCK = threading.RLock()

_is_forked = False


class ForkedError(CubicCraftError):
    """The process was forked from one in which the engine had started."""


def alone(function):
    """Return the function, so that it holds `LOCK` while it runs."""

    @functools.wraps(function)
    def locked(*args, **kwargs):
        with LOCK:
            return function(*args, **kwargs)

    return locked


def is_forked():
    """Return whether this process has an engine without threads, which must not be touched."""
    return _is_forked


def check_not_forked():
    """Raise a ForkedError if the engine's threads stayed in the process that this is a fork of."""
    if _is_forked:
        raise ForkedError(
            f"{engine().name} cannot be used in a process that was forked after it had started;"
            ' choose the device auto or numpy, or the start method "spawn"'
        )


def _begin_in_child():
    global _is_forked
    program = started_program()
    if program is not None:
        _is_forked = True
        # One reference for ever: at the end of the process, the program would wait for its threads.
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(program))
    LOCK.release()  # it was taken by this thread, the only one that the child has


if hasattr(os, "register_at_fork"):  # not on Windows, which does not fork
    os.register_at_fork(
        before=LOCK.acquire, after_in_parent=LOCK.release, after_in_child=_begin_in_child
    )
