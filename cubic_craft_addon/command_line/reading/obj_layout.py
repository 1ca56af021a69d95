# SPDX-License-Identifier: GPL-3.0-or-later
"""Which vertex of an .obj file is which vertex in Blender.

Blender's importer drops vertices that no face or edge uses and deals the others out to the objects
of the file. To give a result back with the vertices of the file, in its order, the text is read
once more for the indices alone; the loose vertices are put back into the meshes.
"""

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import bmesh
import bpy
import numpy as np

from ....solver.console.errors import InputError
from ....solver.console.obj_lines import vertex_of
from ...mesh_bridge import read_position
from .far_away import middle_if_far
from .obj_copy import file_named
from .obj_lines import ObjLines


@dataclass
class ObjLayout:
    """The vertices of an .obj file and who uses them."""

    positions: np.ndarray
    """(n,3) float32, in the order of the file, from `offset`"""
    parts: list[tuple[np.ndarray, np.ndarray]]
    """per object of the file the indices, ascending, that its faces and lines use, and these with
    those that lie in its part of the file and that nothing uses"""
    is_split: bool
    """whether Blender may split the file into objects: none shares a vertex with another"""
    libraries: list[Path]
    """the material libraries that the file names and that are there"""
    missing: list[str]
    """those that are not, as they are written"""
    offset: np.ndarray
    """(3,) float64: where the origin is put, from `middle_if_far`"""
    encoding: str
    """of names in the file: utf-8, or latin-1 for any other"""
    is_plain: bool
    """whether Blender reads the file itself right, and not just `readable_copy`"""
    rows: dict[int, np.ndarray] = field(default_factory=dict)
    """for each Blender object, by its session_uid, as names may change, the index in the file of
    each of its vertices"""


def read_layout(path: Path) -> ObjLayout:
    """Read positions and indices of an .obj file; faces that make no sense are passed over.

    Raises InputError: a vertex without three finite coordinates, which Blender would read as zeros.
    """
    coordinates: list[list[bytes]] = []
    sections: list[tuple[int, set[int]]] = [(0, set())]  # first vertex, used vertices
    libraries, lines = [], ObjLines(path)
    for keyword, rest in lines:
        if keyword == b"v":
            coordinates.append(rest.split()[:3])
        elif keyword in (b"f", b"l"):
            sections[-1][1].update(_indices(rest.split(), len(coordinates)))
        elif keyword == b"o":
            sections.append((len(coordinates), set()))
        elif keyword == b"mtllib":
            libraries.append((rest, file_named(rest, path.parent, lines.encoding)))
    positions = _positions(coordinates, path)
    sections = [section for section in sections if section[1]]
    everything = set().union(*(used for _, used in sections))
    offset = middle_if_far(positions[sorted(everything)])
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
    return ObjLayout(
        (positions - offset).astype(np.float32),
        parts,
        is_split,
        [file for _, file in libraries if file],
        [name.decode(errors="replace") for name, file in libraries if not file],
        offset,
        lines.encoding,
        lines.is_plain and not offset.any(),
    )


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
                layout.rows[obj.session_uid] = rows
                unmatched.remove(obj)
                break


def _indices(words: list[bytes], count: int) -> Iterator[int]:
    """Vertex indices, from 0, of the corners "v/vt/vn" of a face or line."""
    for word in words:
        with contextlib.suppress(ValueError):
            index = vertex_of(word, count)
            if 0 <= index < count:
                yield index


def _positions(coordinates: list[list[bytes]], path: Path) -> np.ndarray:
    """Return the positions (n,3) float64."""
    positions = np.full((len(coordinates), 3), np.nan)
    for number, words in enumerate(coordinates):
        with contextlib.suppress(ValueError):
            x, y, z = map(float, words)
            positions[number] = x, y, z
    with np.errstate(over="ignore"):  # infinite in 32 bit
        broken = np.flatnonzero(~np.isfinite(positions.astype(np.float32)).all(axis=1))
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
