# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines of an .obj file, as bytes.

Names in it may be in any encoding, also in one where the last byte of a letter is that of a
backslash, and comments may hold paths. Neither is continued on the next line, as numbers are.
"""

import codecs
from collections.abc import Iterator
from pathlib import Path

__all__ = ("ObjLines",)

WITH_NAMES = (b"o", b"g", b"usemtl", b"mtllib", b"usemap", b"maplib", b"shadow_obj", b"trace_obj")


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
        pending = b""
        for raw in self._raw_lines():
            line = (pending + raw).strip()
            pending = b""
            keyword, *rest = line.split(None, 1) or [b""]
            has_name = keyword in WITH_NAMES
            if line.endswith(b"\\"):
                self.is_plain = False
            if not has_name:
                line = line.partition(b"#")[0].rstrip()
                if line.endswith(b"\\"):
                    pending = line[:-1] + b" "
                    continue
                keyword, *rest = line.split(None, 1) or [b""]
            elif not _is_utf8(line):
                self.encoding, self.is_plain = "latin-1", False
            yield keyword, rest[0] if rest else b""

    def _raw_lines(self) -> Iterator[bytes]:
        with self._path.open("rb") as file:
            if file.read(len(codecs.BOM_UTF8)) == codecs.BOM_UTF8:
                self.is_plain = False
            else:
                file.seek(0)
            for line in file:
                parts = line.splitlines()
                self.is_plain &= len(parts) <= 1  # some end their lines in a carriage return alone
                yield from parts


def _is_utf8(line: bytes) -> bool:
    try:
        line.decode()
    except UnicodeDecodeError:
        return False
    return True
