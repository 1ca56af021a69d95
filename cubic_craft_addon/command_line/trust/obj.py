# SPDX-License-Identifier: GPL-3.0-or-later
"""Material libraries that an .obj file refers to, and the textures that those refer to.

Blender opens them all on reading. Where it may not open one, it is given copies of the file and its
libraries that do not mention it. Everything else stays as it is.
"""

import mmap
import os
import re
from pathlib import Path

from .places import is_inside, say_left_out

_REST = rb"[\t ]+((?:\\\r?\n|[^\r\n])*)"  # of a line, which goes on after a backslash
_LIBRARY = re.compile(rb"^[\t ]*mtllib" + _REST, re.MULTILINE)
_TEXTURE = re.compile(rb"^[\t ]*(map_\w+|bump|disp|decal|refl|norm)" + _REST, re.M | re.I)


def restricted_copy(path: Path, folder: Path) -> Path | None:
    """Copy an .obj and its libraries without what lies outside its folder; None if nothing does.

    `path`: absolute, without links. `folder`: where the copies are written.
    """
    home, lost, materials = path.parent, [], b""
    if not path.stat().st_size:
        return None
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
        rests = [match[1] for match in _LIBRARY.finditer(text)]
        rests.append(os.fsencode(path.with_suffix(".mtl").name))  # which Blender reads as well
        for library in dict.fromkeys(path for rest in rests for _, path in _found(rest, home)):
            if is_inside(library, home):
                materials += _restricted(library, home, lost) + b"\n"
            else:
                lost.append(library)
        if not lost:
            return None
        copy = folder / path.name
        copy.write_bytes(_LIBRARY.sub(b"", text))
    copy.with_suffix(".mtl").write_bytes(materials)
    say_left_out(path, list(map(str, lost)))
    return copy


def _restricted(library: Path, home: Path, lost: list[Path]) -> bytes:
    """Return the text of a library, its textures with absolute paths, those outside left out."""

    def texture(line: re.Match[bytes]) -> bytes:
        found = _found(line[2], library.parent)
        outside = [path for _, path in found if not is_inside(path, home)]
        lost.extend(outside)
        if not found or outside:
            return b"" if outside else line[0]
        options, path = found[0]
        return b" ".join((line[1], options, os.fsencode(path)))

    return _TEXTURE.sub(texture, library.read_bytes())


def _found(rest: bytes, folder: Path) -> list[tuple[bytes, Path]]:
    """Return what there is of the files that the rest of a line may mean, and what is before it.

    Options such as ``-bm 0.2`` may come first, and names may have spaces, quotes, and the
    separators of another system.
    """
    rest = re.sub(rb"\\\r?\n", b" ", rest).strip()
    found = []
    for start in [0, *(match.end() for match in re.finditer(rb"\s+", rest))]:
        name = rest[start:].strip(b"\"'")
        for spelling in dict.fromkeys((name, name.replace(b"\\", b"/"), name.replace(b"_", b" "))):
            path = folder / os.fsdecode(spelling)
            if b"\0" not in spelling and path.exists() and not path.is_dir():
                found.append((rest[:start].strip(), path))
    return found
