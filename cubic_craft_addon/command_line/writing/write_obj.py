# SPDX-License-Identifier: GPL-3.0-or-later
"""Write .obj files with every vertex, in a given order, at full float32 precision.

Blender's own exporter prints six decimals, which ruins meshes that are small, and orders faces by
their materials.
"""

from decimal import Decimal
from itertools import repeat
from pathlib import Path
from typing import NamedTuple, TextIO

import bpy
import numpy as np

from ...mesh_bridge import read_values
from ..reading.obj_copy import in_file
from ..reading.weld import distinct_rows


class ObjPart(NamedTuple):
    """One object of the file."""

    name: str
    mesh: bpy.types.Mesh
    """faces, UVs, materials and normals, the last fitting the positions"""
    positions: np.ndarray
    """(n,3) float, in the space of the file"""
    rows: np.ndarray
    """(n,) int: where in the file, from 0, each vertex goes"""


def write_obj(
    path: Path,
    parts: list[ObjPart],
    positions: np.ndarray,
    libraries: list[str],
    offset: np.ndarray,
    encoding: str,
) -> None:
    """Write the parts to one file.

    Parameters
    ----------
    positions : (n,3) numpy float32 array of all vertices of the file, for those in no part
    libraries : paths of the material libraries to name in the file
    offset : (3,) numpy float64 array: what is added to all positions
    encoding : of names; those that it lacks are in UTF-8, as are paths
    """
    positions = positions.copy()
    for part in parts:
        positions[part.rows] = part.positions
    if offset.any():
        positions = _moved(positions, offset)
    with path.open("w", encoding="utf-8", errors="surrogateescape", newline="\n") as file:
        file.writelines(f"mtllib {library}\n" for library in libraries)
        _write_rows(file, "v", positions)
        counts = [0, 0]
        for part in parts:
            file.write(f"o {in_file(part.name, encoding)}\n")
            vertices = part.rows[read_values(part.mesh.loops, "vertex_index", np.int32)] + 1
            columns = [map(str, vertices.tolist())]
            for number, (keyword, values) in enumerate(_of_corners(part.mesh).items()):
                first, row_of_corner = distinct_rows(values)
                _write_rows(file, keyword, values[first])
                indices = row_of_corner + 1 + counts[number]
                columns.append(map(str, indices.tolist()) if len(values) else repeat(""))
                counts[number] += len(first)
            corners = ["/".join(words).rstrip("/") for words in zip(*columns, strict=False)]
            _write_faces(file, part.mesh, corners, encoding)
            _write_loose_edges(file, part)


def _moved(positions: np.ndarray, offset: np.ndarray) -> np.ndarray:
    """Return float32 positions plus an offset as float64, added as decimals.

    So they get no more digits than float32 has at the origin.
    """
    by = [Decimal(repr(x)) for x in offset.tolist()]
    rows = ((Decimal(str(x)) + y for x, y in zip(row, by, strict=True)) for row in positions)
    return np.array([[float(x) for x in row] for row in rows])


def _of_corners(mesh: bpy.types.Mesh) -> dict[str, np.ndarray]:
    """Return the active UVs and custom normals of all corners, empty where there are none.

    All other normals are what readers work out themselves.
    """
    layer, none = mesh.uv_layers.active, np.empty((0, 3), np.float32)
    uvs = none if layer is None else read_values(layer.uv, "vector", width=2)
    normals = none
    if mesh.has_custom_normals:
        normals = read_values(mesh.corner_normals, "vector", width=3).round(4)
    return {"vt": uvs, "vn": normals + np.float32(0.0)}  # no -0.0


def _write_rows(file: TextIO, keyword: str, values: np.ndarray) -> None:
    """Write rows with the fewest digits that give the same bits back."""
    texts = np.array([str(value) for value in values.ravel()], object).reshape(values.shape)
    file.writelines(f"{keyword} {' '.join(row)}\n" for row in texts)


def _write_faces(file: TextIO, mesh: bpy.types.Mesh, corners: list[str], encoding: str) -> None:
    materials = [material.name if material else "" for material in mesh.materials]
    names = [in_file(name, encoding) for name in materials]
    kinds = {name: np.int32 for name in ("loop_start", "loop_total", "material_index")}
    kinds["use_smooth"] = bool
    columns = [read_values(mesh.polygons, name, kind).tolist() for name, kind in kinds.items()]
    used = shaded = None
    for start, size, material, smooth in zip(*columns, strict=True):
        if names and (name := names[min(material, len(names) - 1)]) != used:
            file.write(f"usemtl {name}\n" if name else "")
            used = name
        if smooth != shaded:
            file.write(f"s {int(smooth)}\n")
            shaded = smooth
        file.write(f"f {' '.join(corners[start : start + size])}\n")


def _write_loose_edges(file: TextIO, part: ObjPart) -> None:
    edges = read_values(part.mesh.edges, "vertices", np.int32, 2)
    is_loose = np.ones(len(edges), dtype=bool)
    is_loose[read_values(part.mesh.loops, "edge_index", np.int32)] = False
    file.writelines(f"l {a} {b}\n" for a, b in (part.rows[edges[is_loose]] + 1).tolist())
