# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines of an .obj file, and whether Blender reads them in the same way."""

import codecs
from collections.abc import Iterator
from pathlib import Path

from ....solver.console.obj_lines import WITH_NAMES, logical_lines


class ObjLines:
    """Iterate over the lines of a file without comments, each as its keyword and the rest.

    Attributes
    ----------
    encoding : str
        Of the names that were met: "utf-8", or where they are not, "latin-1", in which every byte
        is a letter, so that they are written as they were read.
    is_plain : bool
        Whether Blender would have read the lines that were met in the same way. It continues any
        line that ends in a backslash, and knows neither byte order marks nor other encodings.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self.encoding = "utf-8"
        self.is_plain = True

    def __iter__(self) -> Iterator[tuple[bytes, bytes]]:
        for line in map(bytes.strip, logical_lines(self._raw_lines())):
            keyword, *rest = line.split(None, 1) or [b""]
            if keyword not in WITH_NAMES:
                keyword, *rest = line.partition(b"#")[0].split(None, 1) or [b""]
            elif not _is_utf8(line):
                self.encoding, self.is_plain = "latin-1", False
            yield keyword, rest[0].rstrip() if rest else b""

    def _raw_lines(self) -> Iterator[bytes]:
        with self._path.open("rb") as file:
            if file.read(len(codecs.BOM_UTF8)) == codecs.BOM_UTF8:
                self.is_plain = False
            else:
                file.seek(0)
            for line in file:
                parts = line.splitlines()
                self.is_plain &= len(parts) <= 1  # some end their lines in a carriage return alone
                for part in parts:
                    self.is_plain &= not part.rstrip().endswith(b"\\")
                    yield part


def _is_utf8(line: bytes) -> bool:
    try:
        line.decode()
    except UnicodeDecodeError:
        return False
    return True
