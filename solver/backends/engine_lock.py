# SPDX-License-Identifier: GPL-3.0-or-later
"""One user of Taichi at a time: a process has its program, its modules and its threads only once.

Taichi may be used from any thread, but it is not made for two at once, and what we replace for the
time of its import or of a compilation is replaced for all threads. So whatever touches it holds
`LOCK`. A fork waits until nobody does. The child has Taichi's program, but none of its threads, and
would wait for them for ever: see `check_not_forked`.
"""

import ctypes
import functools
import os
import sys
import threading

from ..errors import CubicCraftError

LOCK = threading.RLock()

_is_forked = False


class ForkedError(CubicCraftError):
    """The process was forked from one in which Taichi had started."""


def alone(function):
    """Return the function, so that it holds `LOCK` while it runs."""

    @functools.wraps(function)
    def locked(*args, **kwargs):
        with LOCK:
            return function(*args, **kwargs)

    return locked


def is_forked():
    """Return whether this process has a Taichi without threads, which must not be touched."""
    return _is_forked


def check_not_forked():
    """Check that Taichi's threads are there.

    Raises
    ------
    ForkedError
        They stayed in the process that this one was forked from.
    """
    if _is_forked:
        raise ForkedError(
            "Taichi cannot be used in a process that was forked after it had started; choose the"
            ' device auto or numpy, or the start method "spawn"'
        )


def _program():
    """Return Taichi's program, ours or that of others, or None if it has not started."""
    try:
        return sys.modules["taichi"].lang.impl.get_runtime().prog
    except (KeyError, AttributeError):  # not imported, not wholly, or broken
        return None


def _begin_in_child():
    global _is_forked
    program = _program()
    if program is not None:
        _is_forked = True
        # One reference for ever: at the end of the process, the program would wait for its threads.
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(program))
    LOCK.release()  # it was taken by this thread, the only one that the child has


if hasattr(os, "register_at_fork"):  # not on Windows, which does not fork
    os.register_at_fork(
        before=LOCK.acquire, after_in_parent=LOCK.release, after_in_child=_begin_in_child
    )
