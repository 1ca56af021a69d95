# SPDX-License-Identifier: GPL-3.0-or-later
"""The output: checked before any work is done, and never left half-written."""

import contextlib
import os
import platform
import stat
import tempfile
from collections.abc import Iterator
from pathlib import Path

from solver.console.errors import InputError

__all__ = ("check_writable", "replacing")

_WRITABLE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH
_LONGEST_STEM = 60  # characters of it in the name of the temporary file


def check_writable(path: Path) -> None:
    """Refuse a path that cannot be written, before the long work starts.

    Raises
    ------
    InputError
    """
    if path.is_dir():
        raise InputError(f"{path}: this is a folder; give the name of a file")
    if path.is_symlink():
        raise InputError(f"{path}: this is a link, which is not replaced; give another name")
    if path.exists() and not path.stat().st_mode & _WRITABLE:
        raise InputError(f"{path}: this file is write-protected; give another name")
    if path.exists() and not path.is_file():
        raise InputError(f"{path}: is a device or a pipe; give a file, or - for standard output")
    if not path.parent.is_dir():
        raise InputError(f"{path}: the folder {path.parent} does not exist; create it")
    try:
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        reason = error.strerror or error
        message = f"{path}: cannot write to {path.parent} ({reason}); choose another folder"
        raise InputError(message) from error


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside ``path`` and move it there if the block succeeds.

    It has the same suffix, by which writers know the format, and is removed however the block ends.

    Raises
    ------
    InputError
        The file cannot be written.
    """
    stem = path.stem[:_LONGEST_STEM]
    temporary = path.with_name(f".{stem}.cubic_craft-{platform.node()}-{os.getpid()}{path.suffix}")
    try:
        temporary.unlink(missing_ok=True)  # it might be a link to another place
        yield temporary
        if not temporary.is_file() or not temporary.stat().st_size:
            raise InputError(f"{path}: nothing was written; is the disk full?")
        temporary.replace(path)
    except OSError as error:
        message = f"{path}: cannot be written ({error.strerror or error}); choose another path"
        raise InputError(message) from error
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
