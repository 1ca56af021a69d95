# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that one process does at a time, also of several machines that share a folder.

As `cubic_craft_addon/environment/lock.py`, for processes without Blender.
"""

import contextlib
import os
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import BinaryIO

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

__all__ = ("alone_at",)

ASKED_EVERY = 0.2
"""seconds"""


@contextlib.contextmanager
def alone_at(path: Path, is_wanted: Callable[[], bool]) -> Iterator[bool]:
    """Wait until no other process has this block for a file; give False if it gave up waiting.

    The system ends the block of a process that is gone. Where a file system has no locks, nobody
    waits.

    Parameters
    ----------
    is_wanted : asked now and then; when it is not, there is no more waiting
    """
    place = path.with_name(f".{path.name}.lock")
    while (file := _locked(place)) is None and is_wanted():
        time.sleep(ASKED_EVERY)
    try:
        yield file is not None
    finally:
        if file is not None:
            if sys.platform == "win32":  # which removes no file that is open
                file.close()
            with contextlib.suppress(OSError):
                place.unlink()
            file.close()


def _locked(place: Path) -> BinaryIO | None:
    """Open and lock a file; None if another process has it, or has just removed it."""
    file = place.open("ab")
    try:
        if sys.platform == "win32":
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        file.close()
        return None
    except OSError:
        pass  # the file system has no locks
    with contextlib.suppress(FileNotFoundError):
        if os.path.samestat(os.fstat(file.fileno()), place.stat()):
            return file
    file.close()
    return None
