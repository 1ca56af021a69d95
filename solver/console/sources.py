# SPDX-License-Identifier: GPL-3.0-or-later
"""The files that are given on a command line: one by one, or by the folders that they lie in."""

import os
import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from .many import in_words
from .output import InputError


def listing(suffixes: Sequence[str]) -> str:
    """Suffixes as readable text: ``".obj, .ply or .blend"``."""
    *others, last = suffixes
    return f"{', '.join(others)} or {last}" if others else last


def folded(name: str) -> str:
    """Return what is the same for all names that are one file on some system."""
    return unicodedata.normalize("NFC", name).casefold()


def check_source(path: Path, readable: Sequence[str]) -> None:
    """Refuse a file that is not there or of another kind, and a device or a pipe, without an end.

    Raises InputError.
    """
    if path.suffix.lower() not in readable:
        kind = f"{path.suffix!r} files" if path.suffix else "files without a suffix"
        raise InputError(f"{path}: cannot read {kind}; give {listing(readable)}")
    if not path.exists():
        raise InputError(f"{path}: there is no such file; check the path")
    if not path.is_file() and not path.is_dir():
        raise InputError(f"{path}: is a device or a pipe; give a file")


def check_suffix(name: str, path: Path, allowed: Sequence[str]) -> None:
    """Refuse a path to be written with another suffix; `name` is what messages call it.

    Raises InputError.
    """
    if path.suffix.lower() not in allowed:
        raise InputError(f"{name}: the name must end in {listing(allowed)}")


def check_content(path: Path) -> None:
    """Refuse a file that is empty or may not be read.

    Raises InputError.
    """
    try:
        with path.open("rb") as file:
            is_empty = not file.read(1)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    if is_empty:
        raise InputError(f"{path}: the file is empty; export it again")


def find_sources(
    inputs: Iterable[Path],
    readable: Sequence[str],
    cure: str,
    *,
    is_recursive: bool = False,
    left_out: Path | None = None,
) -> tuple[list[tuple[Path, Path]], Counter[str]]:
    """List the given files and those in the given folders, folders in order of name.

    Left out are hidden files, what lies in the folder `left_out`, as that is results, and what is
    not a regular file, as a pipe or a device may have no end.

    `cure`: what to do instead of giving a folder without any. Returns each path, with the folder
    that was given or that it lies in; and how many files of other kinds there are, by their
    suffixes. Raises InputError: a folder cannot be read, or holds nothing that can.
    """
    found: list[tuple[Path, Path]] = []
    kinds: Counter[str] = Counter()
    for given in inputs:
        if not given.is_dir():
            found.append((given, given.parent))
            continue
        there = list(_files_in(given, is_recursive, left_out and left_out.resolve()))
        paths = [path for path in there if path.suffix.lower() in readable]
        own = Counter(path.suffix.lower() for path in there if path not in paths)
        if not paths:
            only = f", only {in_words(own)}" if own else ""
            raise InputError(
                f"{given}: there are no meshes in this folder{only}; {cure}"
                f" (meshes are {listing(readable)})"
            )
        found += [(path, given) for path in paths]
        kinds += own
    return found, kinds


def make_folder(name: str, folder: Path) -> None:
    """Make a folder for results if it is not there; `name` is what messages call it.

    Raises InputError: it cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"{name}: cannot be made ({reason}); choose another") from error


def _files_in(folder: Path, is_recursive: bool, left_out: Path | None) -> Iterator[Path]:
    for place, folders, names in os.walk(folder, onerror=_refuse):
        inner = [name for name in sorted(folders) if is_recursive and name[0] != "."]
        folders[:] = [name for name in inner if Path(place, name).resolve() != left_out]
        paths = (Path(place, name) for name in sorted(names) if name[0] != ".")
        yield from (path for path in paths if path.is_file())


def _refuse(error: OSError) -> None:
    message = f"{error.filename}: cannot be read ({error.strerror}); check the folder"
    raise InputError(message) from error
