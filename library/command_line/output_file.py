# SPDX-License-Identifier: GPL-3.0-or-later
"""The output: checked before any work is done, and never left half-written."""

import contextlib
import os
import platform
import stat
from collections.abc import Iterator
from pathlib import Path

from solver.console.errors import InputError
from solver.console.output import check_folder, check_place, errors_of, move_into_place

__all__ = ("check_writable", "replacing")

_WRITABLE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH
_LONGEST_STEM = 60  # characters of it in the name of the temporary file


def check_writable(path: Path) -> None:
    """Refuse a path that cannot be written, before the long work starts.

    Raises
    ------
    InputError
    """
    check_place(str(path), path)
    if path.is_symlink():
        raise InputError(f"{path}: this is a link, which is not replaced; give another name")
    if path.exists() and not path.stat().st_mode & _WRITABLE:
        raise InputError(f"{path}: this file is write-protected; give another name")
    if path.exists() and not path.is_file():
        raise InputError(f"{path}: is a device or a pipe; give a file, or - for standard output")
    check_folder(str(path), path.parent)


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
        with errors_of(path):
            temporary.unlink(missing_ok=True)  # it might be a link to another place
            yield temporary
            move_into_place(temporary, path)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
