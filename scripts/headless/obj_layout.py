# SPDX-License-Identifier: GPL-3.0-or-later
"""Which vertex of an .obj file is which vertex in Blender.

Blender's importer drops vertices that no face or edge uses and deals the others out to the objects
of the file. To give a result back with the vertices of the file, in its order, the text is read
once more for the indices alone; the loose vertices are put back into the meshes.
"""

import codecs
import contextlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import bmesh
import bpy
import numpy as np

from .errors import InputError
from .mesh_arrays import positions_of

__all__ = ("ObjLayout", "match_objects", "read_layout")


@dataclass
class ObjLayout:
    """The vertices of an .obj file and who uses them."""

    positions: np.ndarray
    """(n,3) float32, in the order of the file"""
    parts: list[tuple[np.ndarray, np.ndarray]]
    """per object of the file the indices, ascending, that its faces and lines use, and these with
    those that lie in its part of the file and that nothing uses"""
    is_split: bool
    """whether Blender may split the file into objects: none shares a vertex with another"""
    library: Path | None
    """the material library, if the file has one"""
    rows: dict[str, np.ndarray] = field(default_factory=dict)
    """for each Blender object, by name, the index in the file of each of its vertices"""


def read_layout(path: Path) -> ObjLayout:
    """Read positions and indices of an .obj file; faces that make no sense are passed over.

    Raises
    ------
    InputError
        A vertex without three finite coordinates, which Blender would read as zeros, or a byte
        order mark.
    """
    coordinates: list[list[str]] = []
    sections: list[tuple[int, set[int]]] = [(0, set())]  # first vertex, used vertices
    library = None
    for line in _logical_lines(path):
        keyword, *words = line.split() or [""]
        if keyword == "v":
            coordinates.append(words[:3])
        elif keyword in ("f", "l"):
            sections[-1][1].update(_indices(words, len(coordinates)))
        elif keyword == "o":
            sections.append((len(coordinates), set()))
        elif keyword == "mtllib":
            library = path.parent / line.partition("mtllib")[2].strip()
    positions = _positions(coordinates, path)
    sections = [section for section in sections if section[1]]
    everything = set().union(*(used for _, used in sections))
    is_split = len(everything) == sum(len(used) for _, used in sections)
    if not is_split:
        sections = [(0, everything)]
    loose = np.array(sorted(set(range(len(positions))) - everything), np.int64)
    # Those that nothing uses go to the object that they lie in, or to the one before.
    part_of_loose = np.searchsorted([first for first, _ in sections[1:]], loose, side="right")
    parts = []
    for number, (_, used) in enumerate(sections):
        indices = np.array(sorted(used), np.int64)
        parts.append((indices, np.union1d(indices, loose[part_of_loose == number])))
    return ObjLayout(positions, parts, is_split, library)


def match_objects(layout: ObjLayout, objects: list[bpy.types.Object]) -> None:
    """Find each Blender object in the file, give it back its loose vertices, and fill ``rows``.

    An object that is not what the file says (invalid faces, curves) gets no row.
    """
    unmatched = list(objects)
    for used, rows in layout.parts:
        for obj in unmatched:
            if _has_positions(obj.data, layout.positions[used]):
                if len(rows) > len(used):
                    _add_loose(obj.data, used, rows, layout.positions)
                layout.rows[obj.name] = rows
                unmatched.remove(obj)
                break


def _logical_lines(path: Path) -> Iterator[str]:
    """Lines of the file without comments, those that end in a backslash joined."""
    pending = ""
    with path.open("rb") as file:
        if file.read(len(codecs.BOM_UTF8)) == codecs.BOM_UTF8:
            # Blender's importer would pass over the first line, and all numbers would be wrong.
            raise InputError(f"{path}: begins with a byte order mark; save it as UTF-8 without one")
    with path.open(encoding="utf-8", errors="replace") as file:
        for line in file:
            line = pending + line.partition("#")[0].rstrip()
            if line.endswith("\\"):
                pending = line[:-1] + " "
                continue
            pending = ""
            yield line


def _indices(words: list[str], count: int) -> Iterator[int]:
    """Vertex indices, from 0, of the corners "v/vt/vn" of a face or line."""
    for word in words:
        try:
            number = int(word.partition("/")[0])
        except ValueError:
            continue
        index = number - 1 if number > 0 else count + number
        if number and 0 <= index < count:
            yield index


def _positions(coordinates: list[list[str]], path: Path) -> np.ndarray:
    positions = np.full((len(coordinates), 3), np.nan, np.float32)
    for number, words in enumerate(coordinates):
        with contextlib.suppress(ValueError), np.errstate(over="ignore"):  # infinite in 32 bit
            positions[number] = [float(word) for word in words]
    broken = np.flatnonzero(~np.isfinite(positions).all(axis=1))
    if len(broken):
        message = f"{path}: vertex {broken[0] + 1} has no three finite coordinates"
        raise InputError(f"{message} ({' '.join(coordinates[broken[0]])}); repair the file")
    return positions


def _has_positions(mesh: bpy.types.Mesh, wanted: np.ndarray) -> bool:
    # Reading decimals by way of float64 may round the last bit otherwise than Blender does.
    return len(mesh.vertices) == len(wanted) and np.allclose(
        positions_of(mesh), wanted, rtol=1e-6, atol=0.0, equal_nan=True
    )


def _add_loose(
    mesh: bpy.types.Mesh, used: np.ndarray, rows: np.ndarray, positions: np.ndarray
) -> None:
    """Insert the vertices that are in ``rows`` but not in ``used``, in the order of ``rows``."""
    edited = bmesh.new()
    try:
        edited.from_mesh(mesh)
        for vertex, place in zip(edited.verts, np.searchsorted(rows, used), strict=True):
            vertex.index = int(place)
        for place in np.flatnonzero(~np.isin(rows, used)):
            edited.verts.new(positions[rows[place]].tolist()).index = int(place)
        edited.verts.sort()
        edited.to_mesh(mesh)
    finally:
        edited.free()
