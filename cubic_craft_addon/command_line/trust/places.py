# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file may refer to: whole files and folders in the folder that it lies in, and below."""

import os
import sys
from pathlib import Path

from ....solver.console.errors import InputError
from ..process.one_line import one_line


def is_inside(path: str | Path, folder: Path) -> bool:
    """Return whether a path leads to a place in a folder, links followed, and to no device.

    `path`: as it is written, relative to the folder or absolute. `folder`: absolute, without links.
    """
    try:
        place = Path(os.path.realpath(folder / path))
        return place.is_relative_to(folder) and not is_special(place)
    except (OSError, ValueError):  # such as a name with a zero byte
        return False


def refuse_outside(source: Path, references: list[str]) -> None:
    """Raise InputError if a file refers to one that is not in its folder."""
    folder = source.resolve().parent
    for reference in references:
        # As on Windows, where these are folders, so that a file is the same everywhere.
        if not is_inside(reference.replace("\\", "/"), folder):
            raise InputError(
                f"{source}: refers to {reference!r}, which is not a file in its folder; move that "
                "there, or export it again as one file"
            )


def refuse_special(source: Path) -> None:
    """Raise InputError for a device or a pipe, which may have no end."""
    if is_special(source):
        raise InputError(f"{source}: is a device or a pipe; give a file")


def say_left_out(source: Path, names: list[str]) -> None:
    """Tell what of a file is not read, and why."""
    if names:
        what = ", ".join(dict.fromkeys(names))
        words = f"{source}: left out, because its folder has no such file: {what}"
        print(one_line(words), file=sys.stderr)


def is_special(path: Path) -> bool:
    """Return whether there is a device or a pipe, or something else that is no file."""
    return path.exists() and not path.is_file() and not path.is_dir()
