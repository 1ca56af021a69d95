# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures of an .fbx file that are pipes, on which its importer would wait for ever.

All other files outside of its folder are left out when it is open: nearly every .fbx names textures
by the paths that they had where it was made.
"""

import mmap
import os
import re
from pathlib import Path

from ....solver.console.errors import InputError
from .places import is_special

_NAME = re.compile(rb'File[Nn]ame(?::\s*"([^"\r\n]*)"|S(.{4}))', re.DOTALL)
"""in text in quotes; in a binary file behind its length"""
_LONGEST = 4096
"""bytes of a path"""


def check_fbx(path: Path) -> None:
    """Raise InputError if a file that an .fbx refers to is a device or a pipe."""
    folder = path.resolve().parent
    if not path.stat().st_size:
        return
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        for match in _NAME.finditer(data):
            size = int.from_bytes(match[2] or b"", "little")
            name = match[1] or data[match.end() : match.end() + min(size, _LONGEST)]
            place = os.fsdecode(name.partition(b"\0")[0].replace(b"\\", b"/"))
            for found in (folder / place, folder / Path(place).name):
                if is_special(found):
                    raise InputError(f"{path}: refers to {found}, a device or a pipe; remove it")
