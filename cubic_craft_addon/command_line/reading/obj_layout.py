# SPDX-License-Identifier: GPL-3.0-or-later
"""Which vertex of an .obj file is which vertex in Blender.

Blender's importer drops vertices that no face or edge uses and deals the others out to the objects
of the file. To give a result back with the vertices of the file, in its order, the text is read
once more for the indices alone; the loose vertices are put back into the meshes, and a file is one
object in Blender where its objects would not have the vertices in that order.
"""

import codecs
import contextlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import bmesh
import bpy
import numpy as np

from ....solver.console.obj_lines import logical_lines, vertex_of
from ....solver.console.output import InputError
from ...mesh_bridge import read_position


@dataclass
class ObjLayout:
    """The vertices of an .obj file and who uses them."""

    positions: np.ndarray
    """(n,3) float32, in the order of the file"""
    parts: list[tuple[np.ndarray, np.ndarray]]
    """per object in Blender the indices, ascending, that its faces and lines use, and these with
    those that lie in its part of the file and that nothing uses"""
    is_split: bool
    """whether Blender may split the file into its objects, which also have their names then"""
    rows: dict[int, np.ndarray] = field(default_factory=dict)
    """for each Blender object, by its session_uid, as names may change, the index in the file of
    each of its vertices"""


def read_layout(path: Path) -> ObjLayout:
    """Read positions and indices of an .obj file; faces that make no sense are passed over.

    Raises InputError: a vertex without three finite coordinates, which Blender would read as zeros,
    or a byte order mark, with which it would miss the first line.
    """
    data = path.read_bytes()
    if data.startswith(codecs.BOM_UTF8) and data[3:4] != b"#":
        raise InputError(f"{path}: begins with a byte order mark; save it without")
    coordinates: list[list[bytes]] = []
    sections: list[tuple[int, set[int]]] = [(0, set())]  # first vertex, used vertices
    for line in logical_lines(data.splitlines()):
        keyword, *words = line.partition(b"#")[0].split() or [b""]
        if keyword == b"v":
            coordinates.append(words[:3])
        elif keyword in (b"f", b"l"):
            sections[-1][1].update(_indices(words, len(coordinates)))
        elif keyword == b"o":
            sections.append((len(coordinates), set()))
    positions = _positions(coordinates, path)
    sections = [section for section in sections if section[1]]
    parts = _parts(sections, len(positions))
    order = np.concatenate([[], *(rows for _, rows in parts)])
    is_split = np.array_equal(order, range(len(positions)))
    if not is_split:
        everything = set().union(*(used for _, used in sections))
        parts = _parts([(0, everything)], len(positions))
    return ObjLayout(positions, parts, is_split)


def _parts(sections: list[tuple[int, set[int]]], count: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the parts of so many vertices, some of which nothing uses.

    Those go to the object that they lie in, or to the one before.
    """
    loose = np.setdiff1d(np.arange(count), [v for _, used in sections for v in used])
    part_of_loose = np.searchsorted([first for first, _ in sections[1:]], loose, side="right")
    parts = []
    for number, (_, used) in enumerate(sections):
        indices = np.array(sorted(used), np.int64)
        parts.append((indices, np.union1d(indices, loose[part_of_loose == number])))
    return parts


def match_objects(layout: ObjLayout, objects: list[bpy.types.Object]) -> list[bpy.types.Object]:
    """Find each Blender object in the file, give it back its loose vertices, and fill ``rows``.

    Returns the objects in the order of the file. One that is not what the file says (invalid faces,
    curves) gets no row, and comes last.
    """
    found, unmatched = [], list(objects)
    for used, rows in layout.parts:
        for obj in unmatched:
            if _has_positions(obj.data, layout.positions[used]):
                if len(rows) > len(used):
                    _add_loose(obj.data, used, rows, layout.positions)
                layout.rows[obj.session_uid] = rows
                found.append(obj)
                unmatched.remove(obj)
                break
    return found + unmatched


def _indices(words: list[bytes], count: int) -> Iterator[int]:
    """Vertex indices, from 0, of the corners "v/vt/vn" of a face or line."""
    for word in words:
        with contextlib.suppress(ValueError):
            index = vertex_of(word, count)
            if 0 <= index < count:
                yield index


def _positions(coordinates: list[list[bytes]], path: Path) -> np.ndarray:
    """Return the positions (n,3) float32."""
    positions = np.full((len(coordinates), 3), np.nan, np.float32)
    with np.errstate(over="ignore"):  # infinite in 32 bit
        for number, words in enumerate(coordinates):
            with contextlib.suppress(ValueError):
                x, y, z = map(float, words)
                positions[number] = x, y, z
    broken = np.flatnonzero(~np.isfinite(positions).all(axis=1))
    if len(broken):
        words = b" ".join(coordinates[broken[0]]).decode(errors="replace")
        message = f"{path}: vertex {broken[0] + 1} has no three finite coordinates"
        raise InputError(f"{message} ({words}); repair the file")
    return positions


def _has_positions(mesh: bpy.types.Mesh, wanted: np.ndarray) -> bool:
    # Reading decimals by way of float64 may round the last bit otherwise than Blender does.
    return len(mesh.vertices) == len(wanted) and np.allclose(
        read_position(mesh), wanted, rtol=1e-6, atol=0.0, equal_nan=True
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
