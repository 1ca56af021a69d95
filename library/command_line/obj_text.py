# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavefront .obj files as text, of which only the positions of vertices are replaced.

meshio refuses files whose UVs are split at seams, as nearly all are, reads relative indices wrong,
and drops objects, groups and materials. From .obj to .obj, all of them stay as they are here.
"""

import math
from pathlib import Path

import numpy as np

from .errors import InputError

__all__ = ("ObjText",)

PRECISION = 1e-9
"""of the positions that are written, relative to the largest extent of the mesh"""
_WITH_NAMES = ("o", "g", "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj")
_MOST_DECIMALS = 100  # rounding would overflow
_MOST_VERTICES = 2**31 - 1  # more than fit into any memory


class ObjText:
    """An .obj file.

    Parameters
    ----------
    path : Path

    Attributes
    ----------
    points : (n,3) numpy array
    faces : list of (k,s) numpy int arrays
        Consecutive faces with the same number s of corners, in the order of the file.

    Raises
    ------
    InputError
        A vertex or a face makes no sense; the message has the line.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        # Bytes that are no UTF-8, in names, are written as they are read.
        text = path.read_bytes().decode("utf-8-sig", "surrogateescape")
        self._newline = "\r\n" if "\r\n" in text else "\n"
        self._lines = _logical_lines(text.replace("\r\n", "\n").replace("\r", "\n"))
        self._rows: list[int] = []  # number of the line of each vertex
        points: list[list[float]] = []
        blocks: list[list[list[int]]] = []
        for number, line in enumerate(self._lines):
            keyword, *words = line.partition("#")[0].split() or [""]
            if keyword == "v":
                self._rows.append(number)
                points.append(self._coordinates(words, number))
            elif keyword == "f":
                face = [self._index(word, len(points), number) for word in words]
                if len(face) < 3:
                    raise self._error(number, "a face needs at least 3 corners")
                if not blocks or len(blocks[-1][0]) != len(face):
                    blocks.append([])
                blocks[-1].append(face)
        self.points = np.array(points, dtype=np.float64).reshape(-1, 3)
        self.faces = [np.array(block, dtype=np.int64) for block in blocks]
        highest = max((int(block.max()) for block in self.faces), default=-1)
        if highest >= len(points):
            message = f"a face refers to vertex {highest + 1}, but there are only {len(points)}"
            raise InputError(f"{path}: {message}; export it again")

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
            words, hash_sign, comment = lines[row].partition("#")
            begin = ["v", *map(repr, positions[vertex].tolist()), *words.split()[4:]]
            lines[row] = " ".join(begin) + (f" {hash_sign}{comment}" if hash_sign else "")
        if len(moved):
            lines = [_without_normals(line) for line in lines if line.split()[:1] != ["vn"]]
        text = "".join(f"{line}{self._newline}" for line in lines)
        path.write_bytes(text.encode("utf-8", "surrogateescape"))

    def _coordinates(self, words: list[str], number: int) -> list[float]:
        try:
            x, y, z = (float(word) for word in words[:3])
        except ValueError:
            raise self._error(number, "a vertex needs three coordinates") from None
        return [x, y, z]

    def _index(self, word: str, count: int, number: int) -> int:
        """Return a vertex, from 0, of a corner "v/vt/vn"; negative numbers count from the last."""
        try:
            index = int(word.partition("/")[0])
        except ValueError:
            raise self._error(number, f"{word!r} is not a corner of a face") from None
        if index == 0 or not -count <= index <= _MOST_VERTICES:
            raise self._error(number, f"there is no vertex {word.partition('/')[0]}")
        return index - 1 if index > 0 else count + index

    def _error(self, number: int, reason: str) -> InputError:
        line = self._lines[number].strip()[:60]
        return InputError(f"{self._path}: {reason} ({line!r}); export it again")


def _logical_lines(text: str) -> list[str]:
    """Return the lines, those of numbers that end in a backslash joined.

    A name in another encoding may end in the byte of a backslash, and a comment in a path.
    """
    lines, pending = [], ""
    for end in text.split("\n"):
        line, pending = pending + end, ""
        is_continued = line.endswith("\\") and "#" not in line
        if is_continued and line.split(None, 1)[0] not in _WITH_NAMES:
            pending = line[:-1] + " "
        else:
            lines.append(line)
    if pending:
        lines.append(pending)
    if lines and not lines[-1]:  # behind the last newline
        lines.pop()
    return lines


def _without_normals(line: str) -> str:
    """Drop the normals "vn" of the corners "v/vt/vn" of a face."""
    words = line.split()
    if words[:1] != ["f"] or line.count("/") < 2:
        return line
    return " ".join("/".join(word.split("/")[:2]).rstrip("/") for word in words)
