# SPDX-License-Identifier: GPL-3.0-or-later
"""What both command lines ask of a place that they write to."""

import contextlib
import tempfile
from collections.abc import Iterator
from pathlib import Path

from .errors import InputError


def check_place(name: str, path: Path) -> None:
    """Refuse what is a folder, or lies in none; `name` is what messages call it.

    Raises InputError.
    """
    if path.is_dir():
        raise InputError(f"{name}: this is a folder; give the name of a file")
    if not path.parent.is_dir():
        raise InputError(f"{name}: the folder {path.parent} does not exist; create it")


def check_folder(name: str, folder: Path) -> None:
    """Refuse a folder that cannot be written to; `name` is what messages call the file.

    Raises InputError.
    """
    try:
        # Trying is the only check that holds on network drives and read-only mounts alike.
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = error.strerror or error
        message = f"{name}: cannot write to {folder} ({reason}); choose another folder"
        raise InputError(message) from error


@contextlib.contextmanager
def errors_of(path: Path) -> Iterator[None]:
    """Raise an InputError for an OSError of a block that writes a file."""
    try:
        yield
    except OSError as error:
        message = f"{path}: cannot be written ({error.strerror or error}); choose another path"
        raise InputError(message) from error


def move_into_place(temporary: Path, path: Path) -> None:
    """Move what has been written to where it belongs.

    Raises InputError: nothing has been written.
    """
    if not temporary.is_file() or not temporary.stat().st_size:
        raise InputError(f"{path}: nothing was written; is the disk full?")
    temporary.replace(path)
