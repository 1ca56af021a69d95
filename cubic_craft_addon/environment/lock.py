# SPDX-License-Identifier: GPL-3.0-or-later
"""Files and folders that one process works on at a time, also of several machines.

The system lets go of a lock when its process ends, however that ends. Where a file system has no
locks, there are none.
"""

import contextlib
import os
import sys
from pathlib import Path
from typing import BinaryIO

from ...solver.errors import CubicCraftError

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl


class BusyError(CubicCraftError):
    """Another process works there."""


class Lock:
    """What keeps others from a file or a folder, by a file beside it, until it is released.

    Raises BusyError: another process has it.
    """

    def __init__(self, path: Path):
        self._place = path.with_name(f".{path.name}.lock")
        self._file: BinaryIO | None = None
        while self._file is None:
            file = self._place.open("ab")
            try:
                if not _is_locked(file):
                    raise BusyError(
                        f'"{path.name}" is being written by another program; wait until it is done'
                    )
                # The one who had it may have removed the file after we opened it.
                with contextlib.suppress(FileNotFoundError):
                    if os.path.samestat(os.fstat(file.fileno()), self._place.stat()):
                        self._file = file
            finally:
                if self._file is None:
                    file.close()

    def release(self) -> None:
        """Let others work there."""
        if self._file is None:
            return
        if sys.platform == "win32":  # which removes no file that is open
            self._file.close()
        with contextlib.suppress(OSError):
            self._place.unlink()
        self._file.close()
        self._file = None


def _is_locked(file: BinaryIO) -> bool:
    """Lock a file for this process; return False if another one has done so."""
    try:
        if sys.platform == "win32":
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        pass  # the file system has no locks
    return True
