# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface in a glTF file, of which only positions, normals and tangents are replaced.

Materials, textures, UVs, bones and animations stay as they are. The surface is the triangles of the
scene that is shown first, where its nodes or their bones place them, so that parts are solved as
they stand. No library does this: trimesh drops bones, animations and extensions of materials, and
takes integers that stand for fractions as they are; pygltflib keeps all, but knows no surface.
"""

import struct
from collections import Counter, defaultdict, deque
from collections.abc import Iterable, Iterator
from copy import deepcopy
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from solver.console.errors import InputError

from .gltf_data import GltfData

_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_FLOAT, _UNSIGNED = 5126, 5125
_WRONG = (ValueError, LookupError, TypeError, AttributeError, RecursionError, struct.error)
"""what a file raises that is not what it says, or not at all JSON"""


class _Part(NamedTuple):
    """Vertices of a mesh where a node shows them."""

    rows: slice
    """of the points"""
    linear: np.ndarray
    """(1,3,3), or (k,3,3) by bones"""
    offset: np.ndarray
    """(1,3) or (k,3)"""


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
        tree = self._data.tree
        points, triangles = [np.empty((0, 3))], [np.empty((0, 3), np.int64)]
        self._parts: dict[tuple[int, int], _Part] = {}  # by node and accessor of its positions
        nodes = tree.get("nodes", [])
        children = {child for node in nodes for child in node.get("children", ())}
        roots = [number for number in range(len(nodes)) if number not in children]
        world = dict(self._walk(roots))
        scenes = tree.get("scenes")
        shown = scenes[tree.get("scene", 0)].get("nodes", ()) if scenes else roots
        self._shown = [number for number, _ in self._walk(shown) if "mesh" in nodes[number]]
        for number, primitive in self._primitives():
            position = primitive["attributes"]["POSITION"]
            if (number, position) not in self._parts:
                values = self._data.values(position)
                begin = sum(map(len, points))
                rows = slice(begin, begin + len(values))
                part = _Part(rows, *self._place(number, primitive["attributes"], world))
                self._parts[number, position] = part
                placed = (part.linear @ values[:, :3, None])[..., 0] + part.offset
                points.append(placed)
            part = self._parts[number, position]
            corners = self._corners(primitive, part.rows.stop - part.rows.start)
            is_mirrored = np.linalg.det(part.linear).mean() < 0.0
            triangles.append(part.rows.start + (corners[:, ::-1] if is_mirrored else corners))
        self.points, self.triangles = np.concatenate(points), np.concatenate(triangles)

    def _walk(self, roots: Iterable[int]) -> Iterator[tuple[int, np.ndarray]]:
        """Give nodes and all below them once, and the matrix (4,4) of each in the scene."""
        nodes, seen = self._data.tree.get("nodes", []), set[int]()
        queue = deque((root, np.eye(4)) for root in roots)
        while queue:
            number, outer = queue.popleft()
            if number in seen:
                continue
            seen.add(number)
            matrix = outer @ _matrix_of(nodes[number])
            yield number, matrix
            queue.extend((child, matrix) for child in nodes[number].get("children", ()))

    def _primitives(self) -> Iterator[tuple[int, dict[str, Any]]]:
        """Give the triangles of each node that is shown."""
        tree = self._data.tree
        for number in self._shown:
            node = tree["nodes"][number]
            if "EXT_mesh_gpu_instancing" in node.get("extensions", ()):
                raise InputError("has instances of a node; make them nodes of their own")
            for primitive in tree["meshes"][node["mesh"]]["primitives"]:
                mode = primitive.get("mode", _TRIANGLES)
                if mode in (_STRIP, _FAN):
                    raise InputError("has strips or fans of triangles; export plain triangles")
                if mode == _TRIANGLES:  # not points and lines
                    yield number, primitive

    def _place(
        self, number: int, attributes: dict[str, int], world: dict[int, np.ndarray]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return where a node shows its vertices: by its matrix, or by those of its bones."""
        node, matrices = self._data.tree["nodes"][number], world[number][None]
        if "skin" in node and "JOINTS_0" in attributes:
            skin = self._data.tree["skins"][node["skin"]]
            joints = np.stack([world[joint] for joint in skin["joints"]])
            if "inverseBindMatrices" in skin:
                at_rest = self._data.values(skin["inverseBindMatrices"]).reshape(-1, 4, 4)
                joints = joints @ at_rest.swapaxes(1, 2)
            matrices = np.zeros((1, 4, 4))
            for name in (name for name in attributes if name.startswith("JOINTS_")):
                weights = self._data.values(attributes[name.replace("JOINTS", "WEIGHTS")])
                for bones, weight in zip(
                    self._data.values(attributes[name]).T, weights.T, strict=True
                ):
                    matrices = matrices + weight[:, None, None] * joints[bones]
            matrices /= matrices[:, 3:, 3:]  # the sum of the weights
        linear = matrices[:, :3, :3]
        if not (abs(np.linalg.det(linear)) > 0.0).all():
            raise InputError("a node or a bone has a scale of zero; apply its scale")
        return linear, matrices[:, :3, 3]

    def _corners(self, primitive: dict[str, Any], count: int) -> np.ndarray:
        if "indices" not in primitive:
            return np.arange(count - count % 3).reshape(-1, 3)
        corners = self._data.values(primitive["indices"]).ravel().astype(np.int64)
        if corners.max(initial=0) >= count:
            raise InputError(f"a face refers to a vertex that is not among the {count}")
        return corners[: len(corners) - len(corners) % 3].reshape(-1, 3)

    def write(self, path: Path, positions: np.ndarray, rotations: np.ndarray) -> list[str]:
        """Write the file with other positions; return notes of what does not fit them.

        A mesh that several nodes show becomes one for each.
        """
        tree = self._data.tree
        uses = Counter(node.get("mesh") for node in tree["nodes"])
        for number in self._shown:
            node = tree["nodes"][number]
            if uses[node["mesh"]] > 1:
                uses[node["mesh"]] -= 1
                tree["meshes"].append(deepcopy(tree["meshes"][node["mesh"]]))
                node["mesh"] = len(tree["meshes"]) - 1
        users = self._users()
        made: dict[tuple[int, int, int], int] = {}
        for number, primitive in self._primitives():
            attributes = primitive["attributes"]
            position = attributes["POSITION"]
            part = self._parts[number, position]
            R, L, back = rotations[part.rows], part.linear, np.linalg.inv(part.linear)
            maps = {"POSITION": back, "TANGENT": back @ R @ L}
            maps["NORMAL"] = L.swapaxes(1, 2) @ R @ back.swapaxes(1, 2)
            for name in maps.keys() & attributes.keys():
                accessor = attributes[name]
                if (number, position, accessor) not in made:
                    values = self._data.values(accessor).astype(np.float64)
                    is_place = name == "POSITION"
                    vectors = positions[part.rows] - part.offset if is_place else values[:, :3]
                    vectors = (maps[name] @ vectors[..., None])[..., 0]
                    if not is_place:
                        lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
                        vectors /= np.where(lengths > 0.0, lengths, 1.0)
                    values[:, :3] = vectors
                    new = self._replaced(accessor, values, users, is_normal=not is_place)
                    made[number, position, accessor] = new
                attributes[name] = made[number, position, accessor]
        self._data.write(path)
        notes = []
        if any("targets" in primitive for _, primitive in self._primitives()):
            notes.append("morph targets keep their offsets")
        if len(tree.get("scenes", ())) > 1:
            notes.append("only the scene that is shown first is changed")
        return notes

    def _users(self) -> dict[tuple[int, int], set[Any]]:
        """Return what uses the values at a place: meshes, and which of their vertices."""
        users: dict[tuple[int, int], set[Any]] = defaultdict(set)
        for number, mesh in enumerate(self._data.tree["meshes"]):
            for primitive in mesh["primitives"]:
                attributes = primitive["attributes"]
                for accessor in attributes.values():
                    users[self._begin(accessor)].add((number, attributes["POSITION"]))
                for target in primitive.get("targets", ()):
                    for accessor in target.values():
                        users[self._begin(accessor)].add(None)
        return users

    def _begin(self, number: int) -> tuple[int, int]:
        accessor = self._data.tree["accessors"][number]
        return accessor.get("bufferView", -1), accessor.get("byteOffset", 0)

    def _replaced(
        self, number: int, values: np.ndarray, users: dict[Any, set[Any]], *, is_normal: bool
    ) -> int:
        """Return the accessor of new values (k,w): the same if nothing else uses its own."""
        accessor = self._data.tree["accessors"][number]
        kind, ends = accessor["componentType"], {}
        is_alone = len(users[self._begin(number)]) == 1 and "sparse" not in accessor
        if not (is_alone and (kind == _FLOAT or (is_normal and accessor.get("normalized")))):
            values = values.astype(np.float32)
            ends = {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
            return self._data.add(values, componentType=_FLOAT, type=accessor["type"], **ends)
        stored = self._data.stored(accessor, len(values), kind, values.shape[1])
        whole = 1 if kind == _FLOAT else np.iinfo(stored.dtype).max
        stored[:] = values if kind == _FLOAT else np.round(values * whole)
        for name, end in (("min", stored.min(axis=0)), ("max", stored.max(axis=0))):
            if name in accessor:
                accessor[name] = end.tolist()
        return number


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
