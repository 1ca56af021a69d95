"""Find coordinates in .ply and .stl files that are not finite.

Blender's importers turn them into zeros without a word, which would look like a sound mesh.
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
    find = {".ply": _first_in_ply, ".stl": _first_in_stl}[path.suffix.lower()]
    vertex = None
    with contextlib.suppress(ValueError, IndexError):  # a header that makes no sense
        vertex = find(data)
    if vertex is not None:
        raise InputError(f"{path}: vertex {vertex} has no finite coordinates; repair the file")


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
        return next((n for n, row in enumerate(rows) if NOT_FINITE.search(row)), None)
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
