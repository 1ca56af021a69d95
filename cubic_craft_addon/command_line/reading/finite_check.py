# SPDX-License-Identifier: GPL-3.0-or-later
"""Find what Blender's importers of .ply and .stl files do not survive, or hide.

Coordinates that are not there or not finite become zeros without a word, which would look like a
sound mesh. Counts beyond the end of the file take memory until Blender aborts.
"""

import contextlib
import re
from pathlib import Path

import numpy as np

from ....solver.console.output import InputError

PLY_TYPES = {"char": "i1", "uchar": "u1", "int": "i4", "uint": "u4", "float": "f4"}
"""those that NumPy does not call the same"""
CUT_OFF = -1
STL_HEADER = 84
"""bytes of a binary .stl before the first triangle"""
STL_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
NOT_FINITE = re.compile(rb"[+-]?(nan|inf)", re.IGNORECASE)


def refuse_infinite(path: Path) -> None:
    """Check the vertices of a .ply or .stl; files that make no sense are the importer's to refuse.

    Raises InputError: naming the file, the first vertex that is wrong, and the cure.
    """
    data = path.read_bytes()
    vertex = None
    with contextlib.suppress(ValueError, TypeError, IndexError):  # a header that makes no sense
        vertex = (_first_in_ply if path.suffix.lower() == ".ply" else _first_in_stl)(data)
    if vertex == CUT_OFF:
        raise InputError(
            f"{path}: cannot be read (cut off, or its counts are wrong); export it again"
        )
    if vertex is not None:
        raise InputError(f"{path}: vertex {vertex} has no finite coordinates; repair the file")


def _first_in_ply(data: bytes) -> int | None:
    """Index of the first vertex that is not finite, or `CUT_OFF`."""
    header, end, body = data.partition(b"end_header")
    lines = [line.split() for line in header.decode("ascii", "replace").splitlines()]
    elements = [n for n, line in enumerate(lines) if line[:1] == ["element"]]
    if sum(int(lines[n][2]) for n in elements) > len(body):  # rows of a byte each at least
        return CUT_OFF
    if not end or not elements or lines[elements[0]][1] != "vertex":
        return None
    count = int(lines[elements[0]][2])
    body = body[body.find(b"\n") + 1 :]
    own = lines[elements[0] : (elements + [len(lines)])[1]]
    properties = [line for line in own if line[:1] == ["property"]]
    kind = next((line[1] for line in lines if line[:1] == ["format"]), "")
    if kind == "ascii":
        rows = body.split(b"\n", count)[:count]
        is_broken = (NOT_FINITE.search(row) or len(row.split()) < len(properties) for row in rows)
        return next((n for n, broken in enumerate(is_broken) if broken), None)
    order = "<" if kind == "binary_little_endian" else ">"
    types = [np.dtype(PLY_TYPES.get(line[1], line[1])).newbyteorder(order) for line in properties]
    row = np.dtype([(line[2], kind) for line, kind in zip(properties, types, strict=True)])
    vertices = np.frombuffer(body, row, count)
    return _first(~np.logical_and.reduce([np.isfinite(vertices[axis]) for axis in "xyz"]))


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
