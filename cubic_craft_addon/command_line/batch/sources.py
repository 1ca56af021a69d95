# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of a batch, and a name for the results of each that no other has."""

import hashlib
import os
import unicodedata
from collections import Counter
from collections.abc import Iterator
from pathlib import Path, PurePath
from typing import NamedTuple

from ....solver.console.errors import InputError
from ....solver.console.report import in_words
from ..options.formats import READABLE, listing


class Source(NamedTuple):
    """A file to work on."""

    path: Path
    """absolute"""
    name: str
    """of its results, in the output folder: without suffix, with / between folders"""
    label: str
    """what it is called in what is printed"""
    folder: Path | None
    """that was given, and that no link in it may lead out of; None for a file given by its name"""


class Found(NamedTuple):
    """What is in the given files and folders."""

    sources: list[Source]
    left_out: list[Path]
    """meshes that are hidden or no regular file, by how they look or their names"""
    kinds: Counter[str]
    """suffix of what is no mesh that can be read: how many files"""


def find_sources(inputs: list[Path], is_recursive: bool, output_folder: Path) -> Found:
    """List the given files and those in the given folders, each once, folders in order of name.

    Hidden files are left out, and what lies in the output folder, as that is results; and what is
    not a regular file, or a link to none, as a pipe or a device may have no end.

    Raises InputError: a folder cannot be read, or holds nothing that can.
    """
    places: dict[Path, tuple[PurePath, Path | None]] = {}  # in the folder that was given, and that
    left_out, kinds = [], Counter()
    for given in inputs:
        paths, folder = [given], given.parent
        if given.is_dir():
            paths, folder, own = [], given, Counter()
            for path in _files_in(given, is_recursive, output_folder.resolve()):
                if path.suffix.lower() not in READABLE:
                    own.update([path.suffix.lower()] * (path.name[0] != "."))
                elif path.name[0] != "." and path.is_file():
                    paths.append(path)
                else:
                    left_out.append(path)
            if not paths:
                cure = "give another folder" if is_recursive else "give another, or add --recursive"
                only = f", only {in_words(own)}" if own else ""
                raise InputError(
                    f"{given}: there are no meshes in this folder{only}; {cure}"
                    f" (meshes are {listing(READABLE)})"
                )
            kinds += own
        for path in paths:
            # As it can be given to another process; links stay what they are called.
            absolute = Path(os.path.abspath(path))  # noqa: PTH100  # Path.absolute() keeps ".."
            home = given.resolve() if given.is_dir() else None
            places.setdefault(absolute, (path.relative_to(folder), home))
    return Found(_named(places), left_out, kinds)


def _files_in(folder: Path, is_recursive: bool, left_out: Path) -> Iterator[Path]:
    for place, folders, names in os.walk(folder, onerror=_refuse):
        inner = [name for name in sorted(folders) if is_recursive and name[0] != "."]
        folders[:] = [name for name in inner if Path(place, name).resolve() != left_out]
        yield from (Path(place, name) for name in sorted(names))


def _refuse(error: OSError) -> None:
    message = f"{error.filename}: cannot be read ({error.strerror}); check the folder"
    raise InputError(message) from error


def _named(places: dict[Path, tuple[PurePath, Path | None]]) -> list[Source]:
    """Give those that share a name their suffix, then the folder, until none do.

    A name depends on nothing but the file and those it is mistaken for, so that it is the same
    when a batch is started again.
    """
    sources = {path: _names(path, *place) for path, place in places.items()}
    while True:
        count = Counter(_folded(names[0].name) for names in sources.values())
        clashes = [path for path, names in sources.items() if count[_folded(names[0].name)] > 1]
        if not clashes:
            return [names[0] for names in sources.values()]
        for path in clashes:
            del sources[path][0]


def _names(path: Path, place: PurePath, home: Path | None) -> list[Source]:
    """Return a file with its names, each with more of what tells it from others."""
    short, label = place.with_suffix("").as_posix(), place.as_posix()
    long = f"{short}_{path.suffix[1:]}"
    folder = path.parents[len(place.parts) - 1].name or "root"
    digest = hashlib.sha256(os.fsencode(path)).hexdigest()[:8]
    names = {short: label, long: label}
    names |= dict.fromkeys((f"{folder}/{long}", f"{folder}/{long}_{digest}"), f"{folder}/{label}")
    return [Source(path, name, label, home) for name, label in names.items()]


def _folded(name: str) -> str:
    """Return what is the same for names that are the same file somewhere."""
    return unicodedata.normalize("NFC", name).casefold()
