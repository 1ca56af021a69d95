# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that one process does at a time, for which others wait."""

import contextlib
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from ...environment.lock import BusyError, Lock

__all__ = ("alone_at",)

ASKED_EVERY = 0.2
"""seconds"""


@contextlib.contextmanager
def alone_at(path: Path, is_wanted: Callable[[], bool]) -> Iterator[bool]:
    """Wait until no other process has this block for a file; give False if it gave up waiting.

    Parameters
    ----------
    is_wanted : asked now and then; when it is not, there is no more waiting
    """
    while (lock := _lock(path)) is None and is_wanted():
        time.sleep(ASKED_EVERY)
    try:
        yield lock is not None
    finally:
        if lock is not None:
            lock.release()


def _lock(path: Path) -> Lock | None:
    """Return a lock; None if another process has it."""
    try:
        return Lock(path)
    except BusyError:
        return None
