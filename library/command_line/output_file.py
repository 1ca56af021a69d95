# SPDX-License-Identifier: GPL-3.0-or-later
"""The output, checked before any work is done."""

import stat
from pathlib import Path

from solver.console.errors import InputError
from solver.console.output import check_folder, check_place

_WRITABLE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH


def check_writable(path: Path) -> None:
    """Refuse a path that cannot be written, before the long work starts.

    Raises InputError.
    """
    check_place(str(path), path)
    if path.is_symlink():
        raise InputError(f"{path}: this is a link, which is not replaced; give another name")
    if path.exists() and not path.stat().st_mode & _WRITABLE:
        raise InputError(f"{path}: this file is write-protected; give another name")
    if path.exists() and not path.is_file():
        raise InputError(f"{path}: is a device or a pipe; give a file, or - for standard output")
    check_folder(str(path), path.parent)
