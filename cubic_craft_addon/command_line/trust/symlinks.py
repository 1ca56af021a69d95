# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing is written through a link that lay in the output folder before."""

from collections.abc import Iterable
from pathlib import Path

from ....solver.console.errors import InputError


def refuse_links(option: str, folder: Path, places: Iterable[Path]) -> None:
    """Raise InputError if a folder that is written to is a link, or lies behind one.

    `option`: for the message. `folder`: what was given, which may itself be a link. `places`:
    folders in it at any depth, or itself, absolute.
    """
    home = folder.resolve()
    for place in places:
        for part in (place, *place.parents):
            if part == home:
                break
            if part.is_symlink():
                raise InputError(f"{option} {folder}: {part} is a link; remove it")


def refuse_links_in(option: str, folders: Iterable[Path]) -> None:
    """Raise InputError if a folder is a link, or has one in it, where we go on with its files."""
    for folder in folders:
        for place in (folder, *folder.rglob("*")):
            if place.is_symlink():
                raise InputError(f"{option}: {place} is a link; remove it")
