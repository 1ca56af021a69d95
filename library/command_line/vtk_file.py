# SPDX-License-Identifier: GPL-3.0-or-later
"""Read surfaces from legacy .vtk files, as VTK, PyVista and ParaView write them.

meshio knows neither the data set POLYDATA, in which these programs write surfaces, nor normals,
texture coordinates and other attributes. Lines and strips of several cells are taken apart.
"""

import itertools
from pathlib import Path
from typing import Any, BinaryIO
from urllib.parse import quote, unquote

import meshio
import numpy as np

from solver.console.errors import InputError

__all__ = ("read_vtk", "with_quoted_names")

DATA_SETS = ("POLYDATA", "UNSTRUCTURED_GRID")
TYPES = {
    **{"unsigned_char": "u1", "char": "i1", "unsigned_short": "u2", "short": "i2"},
    **{"unsigned_int": "u4", "int": "i4", "unsigned_long": "u8", "long": "i8", "float": "f4"},
    **{"double": "f8", "vtkidtype": "i4", "vtktypeint8": "i1", "vtktypeuint8": "u1"},
    **{"vtktypeint16": "i2", "vtktypeuint16": "u2", "vtktypeint32": "i4", "vtktypeuint32": "u4"},
    **{"vtktypeint64": "i8", "vtktypeuint64": "u8", "vtktypefloat32": "f4"},
    **{"vtktypefloat64": "f8", "signed_char": "i1", "long_long": "i8", "unsigned_long_long": "u8"},
}
WIDTHS = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9, "TENSORS6": 6}
WIDTHS |= {"GLOBAL_IDS": 1, "PEDIGREE_IDS": 1, "EDGE_FLAGS": 1}
"""numbers in a row of an attribute"""
VERTEX, VERTICES, LINE, LINES, TRIANGLE, STRIP, POLYGON, PIXEL, QUAD = 1, 2, 3, 4, 5, 6, 7, 8, 9
SECTIONS = {"VERTICES": VERTICES, "LINES": LINES, "POLYGONS": POLYGON, "TRIANGLE_STRIPS": STRIP}
NAMES = {VERTEX: "vertex", LINE: "line", TRIANGLE: "triangle", QUAD: "quad", POLYGON: "polygon"}
SAFE = "".join(chr(c) for c in range(33, 127) if chr(c) not in '%"')
"""what a name may have; all else is %20 and so on"""


def read_vtk(path: Path) -> Any:
    """Return a meshio.Mesh; None for a data set that is for meshio to read.

    Raises
    ------
    InputError
        It is cut off, or has what is not known here; the message lacks the path.
    """
    with path.open("rb") as file:
        reader = _Reader(file, path.stat().st_size)
        return reader.mesh() if reader.read() else None


def with_quoted_names(data: dict[str, Any]) -> dict[str, Any]:
    """Return data under names as they stand in such a file, without spaces."""
    return {quote(name, SAFE): values for name, values in data.items()}


class _Reader:
    """A file, and what was read of it."""

    def __init__(self, file: BinaryIO, size: int) -> None:
        self._file, self._size = file, size
        self.points = np.empty((0, 3))
        self.cells: list[list[Any]] = []  # offsets (k+1,), corners and types (k,)
        self.data: dict[str, dict[str, np.ndarray]] = {"POINT_DATA": {}, "CELL_DATA": {}, "": {}}
        self._rows, self._active = 0, ""

    def read(self) -> bool:
        """Read the file, unless its data set is another one."""
        begin = self._file.readline().split()
        if begin[:4] != [b"#", b"vtk", b"DataFile", b"Version"]:
            raise InputError("this is not a legacy .vtk file; export it again")
        self._is_new = float(begin[4]) >= 5.0
        self._file.readline()  # the title
        self._is_text = self._words() == ["ASCII"]
        while words := self._words():
            keyword = words[0].upper()
            if keyword == "DATASET":
                if words[1].upper() not in DATA_SETS:
                    return False
            elif keyword == "METADATA":
                self._skip_metadata()
            elif keyword == "POINTS":
                self.points = self._numbers(int(words[1]), 3, words[2])
            elif keyword in SECTIONS:
                offsets, corners = self._cells(int(words[1]), int(words[2]))
                kinds = np.full(len(offsets) - 1, SECTIONS[keyword])
                self.cells.append([offsets, corners, kinds])
            elif keyword == "CELLS":
                self.cells.append([*self._cells(int(words[1]), int(words[2])), None])
            elif keyword == "CELL_TYPES":
                self.cells[-1][2] = self._numbers(int(words[1]), 1, "int").ravel()
            elif keyword in ("POINT_DATA", "CELL_DATA"):
                self._active, self._rows = keyword, int(words[1])
            else:
                self._attribute(keyword, words)
        return True

    def mesh(self) -> Any:
        """Return what was read, in blocks of cells with one type and number of corners."""
        blocks, rows = [], []
        first = 0
        for offsets, corners, kinds in self.cells:
            if kinds is None or len(kinds) != len(offsets) - 1:
                raise InputError("its cells and their types are not as many; export it again")
            for kind, block, row in _blocks(offsets, corners, kinds):
                blocks.append((kind, block))
                rows.append(row + first)
            first += len(kinds)
        cell_data = {name: [x[row] for row in rows] for name, x in self.data["CELL_DATA"].items()}
        point_data = self.data["POINT_DATA"]
        for data, count in ((point_data, len(self.points)), (self.data["CELL_DATA"], first)):
            for name, values in data.items():
                if len(values) != count:
                    raise InputError(
                        f"{name} has {len(values)} values for {count}; export it again"
                    )
        return meshio.Mesh(self.points, blocks, point_data, cell_data)

    def _skip_metadata(self) -> None:
        """Pass over lines up to an empty one."""
        while self._file.readline().strip():
            pass

    def _words(self) -> list[str]:
        """Return the words of the next line that has any; none at the end."""
        while line := self._file.readline():
            if words := line.decode(errors="replace").split():
                return words
        return []

    def _numbers(self, rows: int, width: int, kind: str) -> np.ndarray:
        """Read an array (rows,width), in the byte order of the machine."""
        name = TYPES.get(kind.lower())
        if name is None:
            raise InputError(f"has data of the type {kind}, which is not read; export it without")
        count, dtype = rows * width, np.dtype(name)
        least = 2 * count - 1 if self._is_text else count * dtype.itemsize
        if min(rows, width) < 0 or least > self._size - self._file.tell():
            raise InputError("is cut off, or its counts are wrong; export it again")
        stored = dtype if self._is_text else dtype.newbyteorder(">")
        values = np.fromfile(self._file, stored, count, " " if self._is_text else "")
        if len(values) != count:
            raise InputError("is cut off, or its counts are wrong; export it again")
        return values.astype(dtype).reshape(rows, width)

    def _cells(self, count: int, size: int) -> tuple[np.ndarray, np.ndarray]:
        """Read cells; return where each begins and the last ends, and the corners of all."""
        if self._is_new:  # counts the offsets
            offsets = self._numbers(count, 1, self._words()[1]).ravel()
            corners = self._numbers(size, 1, self._words()[1]).ravel()
            offsets = offsets if len(offsets) else np.zeros(1, np.int64)
        else:
            values = self._numbers(size, 1, "int").ravel()
            begins = [0]
            sizes = values.tolist()
            for _ in range(count):
                begins.append(begins[-1] + 1 + max(0, sizes[begins[-1]]))
            is_corner = np.ones(size + 1, bool)
            is_corner[np.minimum(begins[:-1], size)] = False
            offsets = np.array(begins) - np.arange(count + 1)
            corners = values[is_corner[:size]]
        if offsets[0] != 0 or offsets[-1] != len(corners) or (np.diff(offsets) < 0).any():
            raise InputError("its cells do not have the corners that they count; export it again")
        return offsets.astype(np.int64), corners

    def _attribute(self, keyword: str, words: list[str]) -> None:
        """Read data of points or cells."""
        found = self.data[self._active]
        name = unquote(words[1]) if len(words) > 1 else ""
        if keyword == "FIELD":
            for _ in range(int(words[2])):
                words = self._words()
                while words[0] == "METADATA":
                    self._skip_metadata()
                    words = self._words()
                width, rows = int(words[1]), int(words[2])
                found[unquote(words[0])] = _row(self._numbers(rows, width, words[3]))
        elif keyword == "SCALARS":
            place = self._file.tell()
            if self._words()[0].upper() != "LOOKUP_TABLE":  # which some leave out
                self._file.seek(place)
            width = int(words[3]) if len(words) > 3 else 1
            found[name] = _row(self._numbers(self._rows, width, words[2]))
        elif keyword == "TEXTURE_COORDINATES":
            found[name] = self._numbers(self._rows, int(words[2]), words[3])
        elif keyword == "COLOR_SCALARS":
            kind = "float" if self._is_text else "unsigned_char"
            found[name] = _row(self._numbers(self._rows, int(words[2]), kind))
        elif keyword == "LOOKUP_TABLE":
            self._numbers(int(words[2]), 4, "float" if self._is_text else "unsigned_char")
        elif keyword in WIDTHS:
            found[name] = _row(self._numbers(self._rows, WIDTHS[keyword], words[2]))
        else:
            raise InputError(f"has a section {keyword[:40]!r}, which is not known; export it again")


def _row(values: np.ndarray) -> np.ndarray:
    """Return single numbers in a row."""
    return values.ravel() if values.shape[1] == 1 else values


def _blocks(offsets: np.ndarray, corners: np.ndarray, kinds: np.ndarray):
    """Give the type, the corners (k,s) and the cells (k,) of each block."""
    sizes = np.diff(offsets)
    kinds = np.where((kinds == POLYGON) & (sizes == 3), TRIANGLE, kinds)
    kinds = np.where((kinds == POLYGON) & (sizes == 4), QUAD, kinds)
    changes = np.flatnonzero((np.diff(kinds) != 0) | (np.diff(sizes) != 0)) + 1
    for begin, end in itertools.pairwise([0, *changes.tolist(), len(kinds)]):
        if begin == end:
            continue
        kind, size = int(kinds[begin]), int(sizes[begin])
        block = corners[offsets[begin] : offsets[end]].reshape(end - begin, size)
        pieces, kind = _pieces(block, kind)
        if kind not in NAMES or (kind == POLYGON and size < 3):
            raise InputError(
                f"has cells of the VTK type {kind} with {size} corners; give a surface of "
                "triangles, quads and polygons"
            )
        count = pieces.shape[1]
        yield (
            NAMES[kind],
            pieces.reshape(-1, pieces.shape[2]),
            np.repeat(np.arange(begin, end), count),
        )


def _pieces(block: np.ndarray, kind: int) -> tuple[np.ndarray, int]:
    """Return the pieces (k,p,s) of cells, and their type."""
    size = block.shape[1]
    if kind == VERTICES:
        return block[:, :, None], VERTEX
    if kind == LINES and size > 1:
        return np.stack([block[:, :-1], block[:, 1:]], axis=2), LINE
    if kind == STRIP and size > 2:
        strip = np.stack([block[:, :-2], block[:, 1:-1], block[:, 2:]], axis=2)
        strip[:, 1::2] = strip[:, 1::2, [1, 0, 2]]  # every other one faces the other way
        return strip, TRIANGLE
    if kind == PIXEL and size == 4:
        return block[:, None, [0, 1, 3, 2]], QUAD
    return block[:, None], kind
