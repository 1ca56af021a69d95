# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines of an .obj file, as bytes.

Names in it may be in any encoding, also in one where the last byte of a letter is that of a
backslash, and comments may hold paths. Neither is continued on the next line, as numbers are.
"""

from collections.abc import Iterable, Iterator

WITH_NAMES = (b"o", b"g", b"usemtl", b"mtllib", b"usemap", b"maplib", b"shadow_obj", b"trace_obj")


def logical_lines(lines: Iterable[bytes]) -> Iterator[bytes]:
    """Join those that are continued with the next, which numbers may be.

    `lines`: without their ends.
    """
    pending = b""
    for end in lines:
        line, pending = pending + end, b""
        if _is_continued(line):
            pending = line.rstrip()[:-1] + b" "
        else:
            yield line
    if pending:
        yield pending


def vertex_of(corner: bytes, count: int) -> int:
    """Return the vertex, from 0, of a corner "v/vt/vn" behind so many vertices.

    Negative numbers count from the last of these. What is no vertex, such as 0, gives a negative
    number, or one that is too large.

    Raises ValueError: it begins with no number.
    """
    number = int(corner.partition(b"/")[0])
    return number - 1 if number >= 0 else count + number


def _is_continued(line: bytes) -> bool:
    keyword, *_ = line.split(None, 1) or [b""]
    is_of_numbers = keyword not in WITH_NAMES and b"#" not in line
    return is_of_numbers and line.rstrip().endswith(b"\\")
