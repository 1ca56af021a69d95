# SPDX-License-Identifier: GPL-3.0-or-later
"""Standard input and output in place of files, by way of a temporary folder.

Readers and writers of meshes go back and forth in their files, which a pipe does not allow.
"""

import contextlib
import os
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from solver.console.errors import InputError
from solver.console.temporary import temporary_folder

STANDARD = "-"
"""in place of a path"""
_INPUT = "standard input"
_BEGINNINGS = {
    b"ply": ".ply",
    b"OFF": ".off",
    b"COFF": ".off",
    b"# vtk": ".vtk",
    b"glTF": ".glb",
    b"{": ".gltf",
    b"<?xml": ".vtu",
    b"<VTKFile": ".vtu",
    b"solid": ".stl",
}
"""the first bytes of a file: its suffix"""
_STL_HEAD = 84  # bytes before the first triangle of a binary file
_STL_TRIANGLE = 50


def format_of(path: Path) -> str:
    """Return the suffix that belongs to what is in a file; .obj has no mark of its own."""
    with path.open("rb") as file:
        head = file.read(_STL_HEAD)
    size = path.stat().st_size
    count = int.from_bytes(head[_STL_HEAD - 4 : _STL_HEAD], "little")
    if len(head) == _STL_HEAD and size == _STL_HEAD + count * _STL_TRIANGLE:
        return ".stl"  # some begin with "solid" all the same
    found = (suffix for mark, suffix in _BEGINNINGS.items() if head.lstrip().startswith(mark))
    return next(found, ".obj")


@contextmanager
def input_file(source: str) -> Iterator[Path]:
    """Give the path of an input: of standard input, that of a temporary copy.

    Raises InputError: nothing comes, or what the block raises, about standard input in place of the
    copy.
    """
    if source != STANDARD:
        yield Path(source)
        return
    with temporary_folder() as folder:
        copy = folder / "input"
        with copy.open("wb") as file:
            shutil.copyfileobj(sys.stdin.buffer, file)
        path = copy.rename(copy.with_suffix(format_of(copy)))
        try:
            yield path
        except InputError as error:
            raise InputError(str(error).replace(str(path), _INPUT)) from error


def write_to_standard_output(path: Path) -> None:
    """Copy a finished file.

    Raises InputError: who reads it has gone, or the disk behind it is full.
    """
    try:
        with path.open("rb") as file:
            shutil.copyfileobj(file, sys.stdout.buffer)
        sys.stdout.buffer.flush()
    except OSError as error:
        with contextlib.suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for the last flush
        raise InputError(f"standard output: cannot be written ({error.strerror})") from error
