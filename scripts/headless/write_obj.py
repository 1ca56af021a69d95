# SPDX-License-Identifier: GPL-3.0-or-later
"""Write .obj files with every vertex, in a given order, at full float32 precision.

Blender's own exporter prints six decimals, which ruins meshes that are small.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

import bpy
import numpy as np

__all__ = ("ObjPart", "write_obj")


@dataclass(frozen=True)
class ObjPart:
    """One object of the file."""

    name: str
    mesh: bpy.types.Mesh
    """faces, UVs, materials and normals, the last fitting the positions"""
    positions: np.ndarray
    """(n,3) float, in the space of the file"""
    rows: np.ndarray
    """(n,) int: where in the file, from 0, each vertex goes"""


def write_obj(path: Path, parts: list[ObjPart], positions: np.ndarray, library: str = "") -> None:
    """Write the parts to one file.

    Parameters
    ----------
    positions : (n,3) numpy float32 array of all vertices of the file, for those in no part
    library : path of a material library to name in the file; none is written
    """
    positions = positions.copy()
    for part in parts:
        positions[part.rows] = part.positions
    with path.open("w", encoding="utf-8", newline="\n") as file:
        if library:
            file.write(f"mtllib {library}\n")
        _write_rows(file, "v", positions)
        uv_count = normal_count = 0
        for part in parts:
            file.write(f"o {part.name}\n")
            uvs, uv_of_corner = _distinct(_uvs(part.mesh))
            normals, normal_of_corner = _distinct(_normals(part.mesh))
            _write_rows(file, "vt", uvs)
            _write_rows(file, "vn", normals)
            corners = _corners(part, uv_of_corner + uv_count, normal_of_corner + normal_count)
            _write_faces(file, part.mesh, corners)
            _write_loose_edges(file, part)
            uv_count += len(uvs)
            normal_count += len(normals)


def _write_rows(file: TextIO, keyword: str, values: np.ndarray) -> None:
    """Write float32 rows with the fewest digits that give the same bits back."""
    texts = np.array([str(value) for value in values.ravel()], object).reshape(values.shape)
    file.writelines(f"{keyword} {' '.join(row)}\n" for row in texts)


def _uvs(mesh: bpy.types.Mesh) -> np.ndarray:
    """(loops,2) float32 of the active UV layer, or (0,2)."""
    layer = mesh.uv_layers.active
    if layer is None:
        return np.empty((0, 2), np.float32)
    uvs = np.empty(len(mesh.loops) * 2, np.float32)
    layer.uv.foreach_get("vector", uvs)
    return uvs.reshape(-1, 2)


def _normals(mesh: bpy.types.Mesh) -> np.ndarray:
    """(loops,3) float32 of custom normals, or (0,3): readers work out all others themselves."""
    if not mesh.has_custom_normals:
        return np.empty((0, 3), np.float32)
    normals = np.empty(len(mesh.loops) * 3, np.float32)
    mesh.corner_normals.foreach_get("vector", normals)
    return normals.reshape(-1, 3).round(4) + np.float32(0.0)  # no -0.0


def _distinct(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distinct rows in the order in which they first occur, and the row of each corner."""
    if not len(values):
        return values, np.empty(0, np.int64)
    as_bytes = np.ascontiguousarray(values).view(f"V{values.itemsize * values.shape[1]}").ravel()
    place: dict[bytes, int] = {}
    row_of_corner = np.array([place.setdefault(key, len(place)) for key in as_bytes.tolist()])
    _, first = np.unique(row_of_corner, return_index=True)
    return values[first], row_of_corner


def _corners(part: ObjPart, uvs: np.ndarray, normals: np.ndarray) -> list[str]:
    """Return "v/vt/vn" of each face corner, counted from 1, with what there is of vt and vn."""
    vertices = np.empty(len(part.mesh.loops), np.int32)
    part.mesh.loops.foreach_get("vertex_index", vertices)
    columns = [part.rows[vertices] + 1]
    form = "{}"
    if len(uvs):
        columns.append(uvs + 1)
        form += "/{}"
    if len(normals):
        columns.append(normals + 1)
        form += "/{}" if len(uvs) else "//{}"
    return [form.format(*numbers) for numbers in zip(*(c.tolist() for c in columns), strict=True)]


def _write_faces(file: TextIO, mesh: bpy.types.Mesh, corners: list[str]) -> None:
    count = len(mesh.polygons)
    starts, sizes, materials = (np.zeros(count, np.int32) for _ in range(3))
    is_smooth = np.zeros(count, dtype=bool)
    mesh.polygons.foreach_get("loop_start", starts)
    mesh.polygons.foreach_get("loop_total", sizes)
    mesh.polygons.foreach_get("material_index", materials)
    mesh.polygons.foreach_get("use_smooth", is_smooth)
    names = [material.name if material else "" for material in mesh.materials]
    state: tuple[object, object] = (None, None)
    for start, size, material, smooth in zip(
        starts.tolist(), sizes.tolist(), materials.tolist(), is_smooth.tolist(), strict=True
    ):
        if names and (name := names[min(material, len(names) - 1)]) != state[0]:
            file.write(f"usemtl {name}\n" if name else "")
            state = (name, state[1])
        if smooth != state[1]:
            file.write(f"s {int(smooth)}\n")
            state = (state[0], smooth)
        file.write(f"f {' '.join(corners[start : start + size])}\n")


def _write_loose_edges(file: TextIO, part: ObjPart) -> None:
    edges = np.empty((len(part.mesh.edges), 2), np.int32)
    part.mesh.edges.foreach_get("vertices", edges.ravel())
    edge_of_corner = np.empty(len(part.mesh.loops), np.int32)
    part.mesh.loops.foreach_get("edge_index", edge_of_corner)
    is_loose = np.ones(len(edges), dtype=bool)
    is_loose[edge_of_corner] = False
    file.writelines(f"l {a} {b}\n" for a, b in (part.rows[edges[is_loose]] + 1).tolist())
