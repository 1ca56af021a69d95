# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of a batch, and a name for the results of each that no other has."""

import os
import unicodedata
from collections import Counter
from pathlib import Path, PurePath

from ....solver.console import sources
from ....solver.console.output import InputError
from ..options.formats import READABLE


def find_sources(
    inputs: list[Path], is_recursive: bool, output_folder: Path
) -> tuple[dict[str, Path], Counter[str]]:
    """Return the absolute paths of all files, by the names of their results.

    Those have no suffix and / between folders. And how many files of other kinds there are, by
    their suffixes. Raises InputError: as `sources.find_sources`; two files would have results of
    one name.
    """
    cure = "give another folder" if is_recursive else "give another, or add --recursive"
    found, kinds = sources.find_sources(
        inputs, READABLE, cure, is_recursive=is_recursive, left_out=output_folder
    )
    places: dict[Path, PurePath] = {}
    for path, folder in found:
        # As it can be given to another process; links stay what they are called.
        absolute = Path(os.path.abspath(path))  # noqa: PTH100  # Path.absolute() keeps ".."
        places.setdefault(absolute, path.relative_to(folder))
    return _named(places), kinds


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
