# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files after what the artist has named, so that no two share a file.

The rules of file systems are narrower than those of Blender: some characters are not allowed, a few
systems ignore case or how accents are stored, and names must be short. What would be one name there
gets a digest of what it is called in Blender.
"""

import hashlib
from collections import Counter
from collections.abc import Iterable

import bpy

from ...solver.console.sources import folded

_LONGEST = 100  # bytes of a name; file systems allow 255 with all that comes before and behind


def file_stems(items: Iterable[bpy.types.ID]) -> dict[bpy.types.ID, str]:
    """Return the names of files for all items of a kind, without suffix.

    A name has no dot but the one in front of a digest, so what follows behind a dot is no part of
    any other name. It depends on nothing but the item and those that it is mistaken for, so that it
    stays the same.
    """
    names = {item: file_stem(item.name) for item in items}
    count = Counter(map(folded, names.values()))
    return {
        item: name if count[folded(name)] == 1 else f"{name}.{_digest(item.name_full)}"
        for item, name in names.items()
    }


def file_stem(name: str) -> str:
    """Return a name that every file system takes; several names may give the same."""
    clean = bpy.path.clean_name(name)
    short = clean.encode()[:_LONGEST].decode(errors="ignore")
    return clean if short == clean else f"{short}.{_digest(name)}"


def _digest(name: str) -> str:
    return hashlib.sha256(name.encode()).hexdigest()[:8]
