# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavefront .obj files as text, of which only the positions of vertices are replaced.

From .obj to .obj, UVs, polygons, objects, groups and materials stay as they are.
"""

import codecs
import math
import os
from pathlib import Path

import numpy as np

from solver.console.obj_lines import logical_lines, vertex_of
from solver.console.output import InputError
from solver.mesh.polygons import triangulate

PRECISION = 1e-9
"""of the positions that are written, relative to the largest extent of the mesh"""
_MOST_DECIMALS = 100  # rounding would overflow
_MOST_VERTICES = 2**31 - 1  # more than fit into any memory


class ObjText:
    """An .obj file.

    `points`: (n,3). `faces`: list of (s,) int arrays in the order of the file; triangles in place
    of those that have a vertex twice. `triangles`: (m,3) int, a virtual triangulation of the faces.
    Raises InputError: a vertex or a face makes no sense; the message lacks the path, and has the
    line.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        # Bytes, as names may be in any encoding, and are written as they are read.
        data = path.read_bytes().removeprefix(codecs.BOM_UTF8)
        self._newline = b"\r\n" if b"\r\n" in data else b"\n"
        self._lines = list(logical_lines(data.splitlines()))
        self._rows: list[int] = []  # number of the line of each vertex
        points: list[list[float]] = []
        blocks: list[list[list[int]]] = []
        for number, line in enumerate(self._lines):
            keyword, *words = line.partition(b"#")[0].split() or [b""]
            if keyword == b"v":
                self._rows.append(number)
                points.append(self._coordinates(words, number))
            elif keyword == b"f":
                face = [self._index(word, len(points), number) for word in words]
                if len(face) < 3:
                    raise self._error(number, "a face needs at least 3 corners")
                if not blocks or len(blocks[-1][0]) != len(face):
                    blocks.append([])
                blocks[-1].append(face)
        self.points = np.array(points, dtype=np.float64).reshape(-1, 3)
        polygons = [np.array(block, dtype=np.int64) for block in blocks]
        highest = max((int(block.max()) for block in polygons), default=-1)
        if highest >= len(points):
            message = f"a face refers to vertex {highest + 1}, but there are only {len(points)}"
            raise InputError(f"{message}; export it again")
        with np.errstate(over="ignore", invalid="ignore"):  # infinite ones the solver refuses
            parts = [triangulate(self.points, block) for block in polygons]
        self.triangles = np.concatenate([np.empty((0, 3), np.int64), *parts])
        self.faces = [
            row
            for block, split in zip(polygons, parts, strict=True)
            for row in (split if _has_one_twice(block) else block)
        ]
        self.face_count = sum(map(len, polygons))

    def write(self, path: Path, positions: np.ndarray) -> None:
        """Write the file with other positions (n,3), and without normals if any of them moved.

        Normals belong to the old shape; programs that read the file compute new ones. Less than
        `PRECISION` is no movement, so that what stays in place keeps its digits.
        """
        lines = list(self._lines)
        step = PRECISION * max(float(np.ptp(self.points, axis=0).max()), 1e-300)
        moved = np.flatnonzero((np.abs(positions - self.points) > step).any(axis=1))
        decimals = max(0, -math.floor(math.log10(step)))
        if decimals < _MOST_DECIMALS:
            positions = np.round(positions, decimals)
        for vertex in moved.tolist():
            row = self._rows[vertex]
            words, hash_sign, comment = lines[row].partition(b"#")
            numbers = (repr(x).encode() for x in positions[vertex].tolist())
            begin = [b"v", *numbers, *words.split()[4:]]
            lines[row] = b" ".join([*begin, *([hash_sign + comment] if hash_sign else [])])
        if len(moved):
            lines = [_without_normals(line) for line in lines if line.split()[:1] != [b"vn"]]
        lines = [_seen_from(path.parent, self._path.parent, line) for line in lines]
        path.write_bytes(b"".join(line + self._newline for line in lines))

    def _coordinates(self, words: list[bytes], number: int) -> list[float]:
        try:
            x, y, z = (float(word) for word in words[:3])
        except ValueError:
            raise self._error(number, "a vertex needs three coordinates") from None
        return [x, y, z]

    def _index(self, corner: bytes, count: int, number: int) -> int:
        """Return the vertex, from 0, of a corner; that it is there is checked at the end."""
        try:
            index = vertex_of(corner, count)
        except ValueError:
            text = corner.decode(errors="replace")
            raise self._error(number, f"{text!r} is not a corner of a face") from None
        if not 0 <= index < _MOST_VERTICES:
            text = corner.partition(b"/")[0].decode()
            raise self._error(number, f"there is no vertex {text}")
        return index

    def _error(self, number: int, reason: str) -> InputError:
        line = self._lines[number].decode(errors="replace").strip()[:60]
        return InputError(f"{reason} ({line!r}); export it again")


def _has_one_twice(faces: np.ndarray) -> bool:
    """Return whether any of the faces (k,s) has a vertex twice, which the solver refuses."""
    in_order = np.sort(faces, axis=1)
    return bool((in_order[:, 1:] == in_order[:, :-1]).any())


def _without_normals(line: bytes) -> bytes:
    """Drop the normals "vn" of the corners "v/vt/vn" of a face."""
    words = line.split()
    if words[:1] != [b"f"] or line.count(b"/") < 2:
        return line
    return b" ".join(b"/".join(word.split(b"/")[:2]).rstrip(b"/") for word in words)


def _seen_from(folder: Path, home: Path, line: bytes) -> bytes:
    """Let a line with a material library, in a file of one folder, name the same in another."""
    keyword, *rest = line.split(None, 1) or [b""]
    name = os.fsdecode(rest[0].strip()) if rest else ""
    is_here = not (home / name).is_file() or (folder / name).is_file()
    if keyword != b"mtllib" or is_here or folder.name.startswith("cubic_craft-"):  # on its way out
        return line
    try:
        place = Path(os.path.relpath((home / name).resolve(), folder.resolve())).as_posix()
    except ValueError:  # on another drive
        return line
    return b"mtllib " + os.fsencode(place)
