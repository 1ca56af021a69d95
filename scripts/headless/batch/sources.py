"""The files of a batch, and a name for the results of each that no other has."""

import hashlib
import os
import unicodedata
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path, PurePath

from ..errors import InputError
from ..formats import READABLE, listing

__all__ = ("Source", "find_sources")


@dataclass(frozen=True)
class Source:
    """A file to work on."""

    path: Path
    """absolute"""
    name: str
    """of its results, in the output folder: without suffix, with / between folders"""
    label: str
    """what it is called in what is printed"""


@dataclass
class _Found:
    path: Path
    """absolute"""
    place: PurePath
    """in the folder that was given; the file's name if it was given itself"""
    distinction: int = 0
    """how much of what tells it from others its name has"""

    @property
    def name(self) -> str:
        name = self.place.with_suffix("").as_posix()
        if self.distinction >= 1:
            name += f"_{self.path.suffix[1:]}"
        if self.distinction >= 2:
            name = f"{self._root}/{name}"
        if self.distinction >= 3:
            name += f"_{hashlib.sha256(os.fsencode(self.path)).hexdigest()[:8]}"
        return name

    @property
    def label(self) -> str:
        place = self.place.as_posix()
        return f"{self._root}/{place}" if self.distinction >= 2 else place

    @property
    def _root(self) -> str:
        return self.path.parents[len(self.place.parts) - 1].name or "root"


def find_sources(inputs: list[Path], is_recursive: bool, output_folder: Path) -> list[Source]:
    """List the given files and those in the given folders, each once, folders in order of name.

    Hidden files are left out, and what lies in the output folder, as that is results.

    Raises
    ------
    InputError
        A folder cannot be read, or holds nothing that can.
    """
    found: dict[Path, _Found] = {}
    for given in inputs:
        if not given.is_dir():
            found.setdefault(_absolute(given), _Found(_absolute(given), PurePath(given.name)))
            continue
        paths = _meshes_in(given, is_recursive, output_folder.resolve())
        if not paths:
            cure = "give another folder" if is_recursive else "give another, or add --recursive"
            raise InputError(
                f"{given}: there are no meshes in this folder; {cure}"
                f" (meshes are {listing(READABLE)})"
            )
        for path in paths:
            found.setdefault(_absolute(path), _Found(_absolute(path), path.relative_to(given)))
    return _named(list(found.values()))


def _meshes_in(folder: Path, is_recursive: bool, left_out: Path) -> list[Path]:
    found = []
    for place, folders, names in os.walk(folder, onerror=_refuse):
        folders[:] = sorted(
            name
            for name in folders
            if is_recursive and not name.startswith(".") and Path(place, name).resolve() != left_out
        )
        found += [Path(place, name) for name in sorted(names) if _is_mesh(name)]
    return found


def _is_mesh(name: str) -> bool:
    return not name.startswith(".") and Path(name).suffix.lower() in READABLE


def _refuse(error: OSError) -> None:
    message = f"{error.filename}: cannot be read ({error.strerror}); check the folder"
    raise InputError(message) from error


def _absolute(path: Path) -> Path:
    """Return the path as it can be given to another process; links stay what they are called."""
    return Path(os.path.abspath(path))  # noqa: PTH100  # Path.absolute() keeps ".."


def _named(found: list[_Found]) -> list[Source]:
    """Give those that share a name their suffix, then the folder, until none do.

    A name depends on nothing but the file and those it is mistaken for, so that it is the same
    when a batch is started again.
    """
    while clashes := _clashes(found):
        for members in clashes:
            for member in members:
                member.distinction += 1
    return [Source(each.path, each.name, each.label) for each in found]


def _clashes(found: list[_Found]) -> list[list[_Found]]:
    """Group files whose names are the same on some file system, where case does not count."""
    groups: dict[str, list[_Found]] = defaultdict(list)
    for each in found:
        groups[unicodedata.normalize("NFC", each.name).casefold()].append(each)
    return [members for members in groups.values() if len(members) > 1]
