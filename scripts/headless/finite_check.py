# SPDX-License-Identifier: GPL-3.0-or-later
"""Find what Blender's importers of .ply and .stl files do not survive, or hide.

Coordinates that are not there or not finite become zeros without a word, which would look like a
sound mesh. Counts beyond the end of the file take memory until Blender aborts.
"""

import contextlib
import re
from pathlib import Path

import numpy as np

from .errors import InputError

__all__ = ("refuse_infinite",)

PLY_TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"),
    **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"),
    **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"),
    **dict.fromkeys(("double", "float64"), "f8"),
}
STL_HEADER = 84
"""bytes of a binary .stl before the first triangle"""
STL_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
NOT_FINITE = re.compile(rb"[+-]?(nan|inf)", re.IGNORECASE)


def refuse_infinite(path: Path) -> None:
    """Check the vertices of a .ply or .stl; files that make no sense are the importer's to refuse.

    Raises
    ------
    InputError
        Naming the file, the first vertex that is wrong, and the cure.
    """
    data = path.read_bytes()
    is_ply = path.suffix.lower() == ".ply"
    vertex, is_whole = None, True
    with contextlib.suppress(ValueError, IndexError):  # a header that makes no sense
        vertex = (_first_in_ply if is_ply else _first_in_stl)(data)
        is_whole = not is_ply or _holds_all(data)
    if not is_whole:
        raise InputError(
            f"{path}: cannot be read (cut off, or its counts are wrong); export it again"
        )
    if vertex is not None:
        raise InputError(f"{path}: vertex {vertex} has no finite coordinates; repair the file")


def _holds_all(data: bytes) -> bool:
    """Return whether a .ply can have as many rows as its header says, of a byte each at least."""
    header, _, body = data.partition(b"end_header")
    rows = [line.split() for line in header.splitlines()]
    return sum(int(row[2]) for row in rows if row[:1] == [b"element"]) <= len(body)


def _first_in_ply(data: bytes) -> int | None:
    """Index of the first vertex that is not finite."""
    header, end, body = data.partition(b"end_header")
    lines = [line.split() for line in header.decode("ascii", "replace").splitlines()]
    elements = [number for number, line in enumerate(lines) if line[:1] == ["element"]]
    if not end or not elements or lines[elements[0]][1] != "vertex":
        return None
    count = int(lines[elements[0]][2])
    body = body[body.find(b"\n") + 1 :]
    properties = [
        line
        for line in lines[elements[0] : (elements + [len(lines)])[1]]
        if line[:1] == ["property"]
    ]
    kind = next((line[1] for line in lines if line[:1] == ["format"]), "")
    if kind == "ascii":
        rows = body.split(b"\n", count)[:count]
        is_broken = (NOT_FINITE.search(row) or len(row.split()) < len(properties) for row in rows)
        return next((n for n, broken in enumerate(is_broken) if broken), None)
    order = "<" if kind == "binary_little_endian" else ">"
    if any(line[1] not in PLY_TYPES for line in properties):
        return None
    row = np.dtype([(line[2], order + PLY_TYPES[line[1]]) for line in properties])
    if len(body) < count * row.itemsize or not {"x", "y", "z"} <= set(row.names or ()):
        return None
    vertices = np.frombuffer(body, row, count)
    is_finite = np.logical_and.reduce([np.isfinite(vertices[axis]) for axis in "xyz"])
    return _first(~is_finite)


def _first_in_stl(data: bytes) -> int | None:
    """Index of the first triangle corner that is not finite."""
    count = int.from_bytes(data[80:STL_HEADER], "little")
    if len(data) == STL_HEADER + count * STL_TRIANGLE.itemsize:
        corners = np.frombuffer(data, STL_TRIANGLE, count, STL_HEADER)["corners"]
        return _first(~np.isfinite(corners).all(axis=2).ravel())
    rows = [line for line in data.splitlines() if line.split()[:1] == [b"vertex"]]
    return next((n for n, row in enumerate(rows) if NOT_FINITE.search(row)), None)


def _first(is_broken: np.ndarray) -> int | None:
    return int(is_broken.argmax()) if is_broken.any() else None
