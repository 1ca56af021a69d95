# SPDX-License-Identifier: GPL-3.0-or-later
"""The layers that a USD file is composed of, which USD opens wherever they lie."""

import mmap
import os
import re
from pathlib import Path

from ....solver.console.errors import InputError
from .places import is_inside
from .usd_crate import MAGIC, tokens

_LAYERS = (".usd", ".usda", ".usdc", ".usdz", ".abc")
_ASSET = re.compile(rb"@@@(.+?)@@@|@([^@\r\n]+)@", re.DOTALL)
_EXPRESSION = "`"
_PACKAGE = b"PK"
"""first bytes of a .usdz, which has other files one after the other, not compressed"""


def check_usd(path: Path) -> None:
    """Look into a USD file, and into the layers in its folder that it refers to.

    Textures are not looked for: they are not needed to read it.

    Raises InputError: a layer lies outside of the folder, or cannot be looked into.
    """
    home = path.resolve().parent
    waiting, seen = [path.resolve()], set()
    while waiting:
        layer = waiting.pop()
        seen.add(layer)
        for reference in _references(layer):
            if reference.startswith(_EXPRESSION):
                raise InputError(f"{path}: a path in it is an expression; export it as one file")
            name = reference.partition(":SDF_FORMAT_ARGS:")[0].partition("[")[0]
            other = Path(os.path.realpath(layer.parent / name.removeprefix("file:")))
            if not other.exists() or other.is_dir():
                continue
            if is_inside(other, home):
                is_new = other.suffix.lower() in _LAYERS and other not in seen
                waiting += [other] if is_new else []
            elif other.suffix.lower() in _LAYERS or not other.is_file():
                raise InputError(
                    f"{path}: refers to {name!r}, which is not a file in its folder; export it "
                    "again as one file"
                )


def _references(layer: Path) -> list[str]:
    """Return all texts in a layer that may be paths."""
    if not layer.stat().st_size:
        return []
    with layer.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        found = []
        if data[: len(MAGIC)] != MAGIC:
            found = [match[1] or match[2] for match in _ASSET.finditer(data)]
        is_package = data[: len(_PACKAGE)] == _PACKAGE
        starts = [match.start() for match in re.finditer(MAGIC, data)] if is_package else [0]
        for start in starts:
            if data[start : start + len(MAGIC)] == MAGIC:
                try:
                    found += tokens(data[start:])
                except (ValueError, IndexError) as error:
                    raise InputError(
                        f"{layer}: cannot be read (no USD file, or cut off); export it again"
                    ) from error
    return [os.fsdecode(text) for text in found if b"\0" not in text]
