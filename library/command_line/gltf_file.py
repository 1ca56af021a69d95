# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface in a glTF file, of which only positions, normals and tangents are replaced.

Scenes, materials, textures, UVs, bones and animations stay as they are. The surface is the
triangles of all meshes where their nodes place them, so that parts are solved as they stand.
"""

import struct
from pathlib import Path
from typing import Any

import numpy as np

from solver.console.errors import InputError

from .gltf_data import GltfData

__all__ = ("GltfFile", "write_surface")

_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_FLOAT, _UNSIGNED = 5126, 5125
_WRONG = (ValueError, LookupError, TypeError, AttributeError, RecursionError, struct.error)
"""what a file raises that is not what it says, or not at all JSON"""


class GltfFile:
    """A .glb or .gltf file.

    Parameters
    ----------
    path : Path

    Attributes
    ----------
    points : (n,3) numpy array
        In the coordinates of the scene.
    triangles : (m,3) numpy int array

    Raises
    ------
    InputError
        It has no surface that can be replaced; the message lacks the path.
    """

    def __init__(self, path: Path) -> None:
        try:
            self._data = GltfData.read(path)
            self._find()
        except _WRONG as error:
            name = path.suffix.lower()
            reason = f"{type(error).__name__}: {error}".splitlines()[0]
            raise InputError(f"cannot be read as {name} ({reason}); export it again") from error

    def _find(self) -> None:
        points, triangles = [np.empty((0, 3))], [np.empty((0, 3), np.int64)]
        self._places: dict[int, tuple[int, np.ndarray]] = {}  # accessor: first point, matrix
        self._turned: dict[int, tuple[int, np.ndarray]] = {}  # and the same of directions
        used: dict[int, np.ndarray] = {}
        count = 0
        for mesh, matrix in self._placed():
            if not np.array_equal(used.setdefault(mesh, matrix), matrix):
                raise InputError("a mesh is used in several places; make it a copy in each")
            for primitive in self._data.tree["meshes"][mesh]["primitives"]:
                mode, attributes = primitive.get("mode", _TRIANGLES), primitive["attributes"]
                if mode < _TRIANGLES:
                    continue  # points and lines
                if mode in (_STRIP, _FAN):
                    raise InputError("has strips or fans of triangles; export plain triangles")
                position = attributes["POSITION"]
                values = self._data.accessor(position)
                if values.dtype != np.float32 or values.shape[1] != 3:
                    raise InputError("its positions are compressed; export it without compression")
                if position not in self._places:
                    self._places[position] = count, matrix
                    points.append(values @ matrix[:3, :3].T + matrix[:3, 3])
                    count += len(values)
                first, own = self._places[position]
                if not np.array_equal(own, matrix):
                    raise InputError("a mesh is used in several places; make it a copy in each")
                triangles.append(first + self._corners(primitive, len(values)))
                linear = matrix[:3, :3]
                if not abs(np.linalg.det(linear)) > 0.0:
                    raise InputError("a node with a mesh has a scale of zero; apply its scale")
                of_normals = np.linalg.inv(linear).T
                for name, own in (("NORMAL", of_normals), ("TANGENT", linear)):
                    if name in attributes:
                        self._turned.setdefault(attributes[name], (first, own))
        self.points, self.triangles = np.concatenate(points), np.concatenate(triangles)

    def _corners(self, primitive: dict[str, Any], count: int) -> np.ndarray:
        if "indices" not in primitive:
            return np.arange(count - count % 3).reshape(-1, 3)
        corners = self._data.accessor(primitive["indices"]).ravel().astype(np.int64)
        if corners.max(initial=0) >= count:
            raise InputError(f"a face refers to a vertex that is not among the {count}")
        return corners[: len(corners) - len(corners) % 3].reshape(-1, 3)

    def _placed(self):
        """Give each mesh in the scene and its matrix (4,4); that of a skin does not count."""
        tree = self._data.tree
        nodes = tree.get("nodes", [])
        children = {child for node in nodes for child in node.get("children", ())}
        stack = [(number, np.eye(4)) for number in range(len(nodes)) if number not in children]
        for _ in nodes:  # no more than there are, whatever refers to what
            if not stack:
                return
            number, outer = stack.pop()
            node = nodes[number]
            matrix = outer @ _matrix_of(node)
            if "mesh" in node:
                yield node["mesh"], np.eye(4) if "skin" in node else matrix
            stack += [(child, matrix) for child in node.get("children", ())]

    def write(self, path: Path, positions: np.ndarray, rotations: np.ndarray) -> list[str]:
        """Write the file with other positions; return notes of what does not fit them."""
        for number, (first, matrix) in self._places.items():
            values = self._data.accessor(number)
            place = slice(first, first + len(values))
            back = np.linalg.inv(matrix)
            values[:] = positions[place] @ back[:3, :3].T + back[:3, 3]
            accessor = self._data.tree["accessors"][number]
            accessor["min"], accessor["max"] = (
                each(values, axis=0).tolist() for each in (np.min, np.max)
            )
        for number, (first, linear) in self._turned.items():
            values = self._data.accessor(number)
            R = rotations[first : first + len(values)]
            vectors = np.einsum("nij,nj->ni", R, values[:, :3] @ linear.T)
            vectors = vectors @ np.linalg.inv(linear).T
            lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
            values[:, :3] = vectors / np.where(lengths > 0.0, lengths, 1.0)
        self._data.write(path)
        meshes = self._data.tree.get("meshes", ())
        if any("targets" in x for mesh in meshes for x in mesh["primitives"]):
            return ["morph targets keep their offsets"]
        return []


def write_surface(path: Path, points: np.ndarray, triangles: np.ndarray) -> None:
    """Write positions (n,3) and triangles (m,3) as a file with one mesh."""
    values = np.asarray(points, np.float32)
    data = GltfData({"asset": {"version": "2.0", "generator": "cubic-craft"}}, bytearray())
    low, high = values.min(axis=0).tolist(), values.max(axis=0).tolist()
    position = data.add(values, componentType=_FLOAT, type="VEC3", min=low, max=high)
    corners = np.asarray(triangles, np.uint32).ravel()
    indices = data.add(corners, componentType=_UNSIGNED, type="SCALAR")
    primitive = {"attributes": {"POSITION": position}, "indices": indices}
    data.tree |= {"meshes": [{"primitives": [primitive]}], "nodes": [{"mesh": 0}]}
    data.tree |= {"scenes": [{"nodes": [0]}], "scene": 0}
    data.write(path)


def _matrix_of(node: dict[str, Any]) -> np.ndarray:
    """Return the matrix (4,4) of a node in that around it."""
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    turn = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix = np.eye(4)
    matrix[:3, :3] = np.array(turn) * node.get("scale", (1.0, 1.0, 1.0))
    matrix[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return matrix
