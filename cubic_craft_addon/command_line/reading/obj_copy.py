# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of an .obj file that Blender reads right.

Its names are in UTF-8, its lines are whole, and it lies at the origin: Blender has 32 bits for a
coordinate, which are too few for a house in the coordinates of its country. Beside it are copies of
its material libraries.
"""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ....solver.console.temporary import temporary_folder
from .obj_lines import ObjLines

WITH_TEXTURES = (b"map_", b"bump", b"norm", b"disp", b"decal", b"refl")
"""how lines of a material library begin that name a file"""
STANDS_FOR_BACKSLASH = "\N{FULLWIDTH REVERSE SOLIDUS}"


@contextlib.contextmanager
def readable_copy(path: Path, encoding: str, offset: np.ndarray) -> Iterator[Path]:
    """Give the path of a copy, of the same name, during the block.

    `path`: of the .obj file. `encoding`: of its names. `offset`: (3,) what is taken from all
    positions.
    """
    with temporary_folder() as folder:
        copy = folder / path.name
        with copy.open("wb") as file:
            file.writelines(_lines(path, copy.parent, encoding, offset))
        yield copy


def file_named(name: bytes, folder: Path, encoding: str) -> Path | None:
    """Return the file that is named in a file of this folder; None if it is not there."""
    names = (name.decode(errors="surrogateescape"), name.decode(encoding, "replace"))
    paths = (folder / text for name in names for text in (name, name.replace("\\", "/")))
    with contextlib.suppress(ValueError):  # a zero in a name
        return next((path for path in paths if path.is_file()), None)
    return None


def in_file(name: str, encoding: str) -> str:
    """Return a name in Blender as a text that is, written in UTF-8, as it was in the file.

    Bytes that are not UTF-8 are surrogates in it. What the encoding lacks is left as it is.
    """
    if name.endswith(STANDS_FOR_BACKSLASH):
        name = name.removesuffix(STANDS_FOR_BACKSLASH) + "\\"
    with contextlib.suppress(UnicodeEncodeError):
        return name.encode(encoding).decode(errors="surrogateescape")
    return name


def _lines(path: Path, folder: Path, encoding: str, offset: np.ndarray) -> Iterator[bytes]:
    libraries = 0
    for keyword, rest in ObjLines(path):
        if keyword == b"v":
            words = rest.split()
            numbers = [float(word) - x for word, x in zip(words, offset.tolist(), strict=False)]
            rest = b" ".join([*(repr(x).encode() for x in numbers), *words[3:]])
        elif keyword == b"mtllib":
            source = file_named(rest, path.parent, encoding)
            if source is None:
                continue
            libraries += 1
            rest = b"%d.mtl" % libraries
            with folder.joinpath(rest.decode()).open("wb") as file:
                file.writelines(_lines_of_library(source, encoding))
        else:
            rest = _in_blender(rest, encoding)
        yield b"%s %s\n" % (keyword, rest)


def _lines_of_library(path: Path, encoding: str) -> Iterator[bytes]:
    for line in path.read_bytes().splitlines():
        line = line.strip()
        has_texture = line.lower().startswith(WITH_TEXTURES)
        whole = _with_whole_path(line, path.parent, encoding) if has_texture else None
        yield (whole or _in_blender(line, encoding)) + b"\n"


def _with_whole_path(line: bytes, folder: Path, encoding: str) -> bytes | None:
    """Return a line with the whole path of its file, which comes behind options, if it is there."""
    before = 0
    while parts := line[before:].split(None, 1)[1:]:
        before = len(line) - len(parts[0])
        found = file_named(parts[0], folder, encoding)
        if found is not None:
            return _in_blender(line[:before], encoding) + os.fsencode(found.absolute())
    return None


def _in_blender(text: bytes, encoding: str) -> bytes:
    """Return the end of a line in UTF-8; a backslash there would continue it."""
    inner = text.removesuffix(b"\\")
    end = STANDS_FOR_BACKSLASH if len(inner) < len(text) else ""
    return (inner.decode(encoding, "replace") + end).encode()
