# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of a batch, and a name for the results of each that no other has."""

import os
import unicodedata
from collections import Counter
from collections.abc import Iterator
from pathlib import Path, PurePath

from ....solver.console.output import InputError
from ....solver.console.report import in_words
from ..options.formats import READABLE, listing


def find_sources(
    inputs: list[Path], is_recursive: bool, output_folder: Path
) -> tuple[dict[str, Path], Counter[str]]:
    """List the given files and those in the given folders, each once, folders in order of name.

    Left out are hidden files, what lies in the output folder, as that is results, and what is not
    a regular file, as a pipe or a device may have no end.

    Returns the absolute paths by the names of their results, which have no suffix and / between
    folders; and how many files of other kinds there are, by their suffixes. Raises InputError: a
    folder cannot be read, or holds nothing that can; two files would have results of one name.
    """
    places: dict[Path, PurePath] = {}  # absolute: in the folder that was given
    kinds: Counter[str] = Counter()
    for given in inputs:
        paths, folder = [given], given.parent
        if given.is_dir():
            there = list(_files_in(given, is_recursive, output_folder.resolve()))
            paths, folder = [path for path in there if path.suffix.lower() in READABLE], given
            own = Counter(path.suffix.lower() for path in there if path not in paths)
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
            places.setdefault(absolute, path.relative_to(folder))
    return _named(places), kinds


def _files_in(folder: Path, is_recursive: bool, left_out: Path) -> Iterator[Path]:
    for place, folders, names in os.walk(folder, onerror=_refuse):
        inner = [name for name in sorted(folders) if is_recursive and name[0] != "."]
        folders[:] = [name for name in inner if Path(place, name).resolve() != left_out]
        paths = (Path(place, name) for name in sorted(names) if name[0] != ".")
        yield from (path for path in paths if path.is_file())


def _refuse(error: OSError) -> None:
    message = f"{error.filename}: cannot be read ({error.strerror}); check the folder"
    raise InputError(message) from error


def _named(places: dict[Path, PurePath]) -> dict[str, Path]:
    """Give those that share a name their suffix, so that it is the same whenever it is given."""
    count = Counter(_folded(place.with_suffix("")) for place in places.values())
    found: dict[str, Path] = {}
    taken: dict[str, Path] = {}
    for path, place in places.items():
        name = place.with_suffix("")
        if count[_folded(name)] > 1:
            name = place.with_name(f"{place.stem}_{place.suffix[1:]}")
        other = taken.setdefault(_folded(name), path)
        if other != path:
            raise InputError(f"{path}: its results would have the names of {other}; rename it")
        found[name.as_posix()] = path
    return found


def _folded(name: PurePath) -> str:
    """Return what is the same for names that are the same file somewhere."""
    return unicodedata.normalize("NFC", name.as_posix()).casefold()
