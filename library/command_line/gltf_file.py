# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface in a glTF file, through trimesh: its nodes, materials, textures and UVs stay.

trimesh drops bones, animations and morph targets. Files with such are refused, as Blender's command
keeps them.
"""

from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from trimesh.exchange import gltf

from solver.console.errors import InputError

_DROPPED = {b'"skins":': "bones", b'"animations":': "animations", b'"targets":': "morph targets"}


class GltfFile:
    """A .glb or .gltf file.

    Parameters
    ----------
    path : Path

    Attributes
    ----------
    points : (n,3) numpy array
        In the coordinates of the scene, where each node shows them.
    triangles : (m,3) numpy int array

    Raises
    ------
    InputError
        It has no surface that can be replaced; the message lacks the path.
    """

    def __init__(self, path: Path) -> None:
        content = path.read_bytes().replace(b'" :', b'":')
        if found := [what for mark, what in _DROPPED.items() if mark in content]:
            cure = "the command of Blender keeps them, blender -c cubic_craft"
            raise InputError(f"has {' and '.join(found)}, which would be lost; {cure}")
        try:
            self._scene: Any = trimesh.load_scene(path, process=False)
            graph, geometry = self._scene.graph, self._scene.geometry
            placed = [(node, *graph[node]) for node in graph.nodes_geometry]
        except Exception as error:  # its readers raise anything
            reason = (f"{type(error).__name__}: {error}".splitlines())[0]
            name = path.suffix.lower()
            raise InputError(f"cannot be read as {name} ({reason}); export it again") from error
        points, triangles, count = [np.empty((0, 3))], [np.empty((0, 3), np.int64)], 0
        self._parts: list[tuple[str, np.ndarray, str]] = []  # node, its matrix (4,4), geometry
        for node, matrix, name in placed:
            mesh = geometry[name]
            if not isinstance(mesh, trimesh.Trimesh):
                continue  # points and lines
            size = np.linalg.det(matrix[:3, :3])
            if not abs(size) > 0.0:
                raise InputError("a node has a scale of zero; apply its scale")
            if mesh.faces.max(initial=-1) >= len(mesh.vertices):
                raise InputError(f"a face refers to a vertex not among the {len(mesh.vertices)}")
            self._parts.append((node, matrix, name))
            points.append(trimesh.transform_points(mesh.vertices, matrix))
            triangles.append(count + (mesh.faces[:, ::-1] if size < 0.0 else mesh.faces))
            count += len(mesh.vertices)
        self.points, self.triangles = np.concatenate(points), np.concatenate(triangles)

    def write(self, path: Path, positions: np.ndarray, rotations: np.ndarray) -> None:
        """Write the file with other positions (n,3), and normals turned by rotations (n,3,3).

        A mesh that several nodes show becomes one for each.
        """
        scene, begin, used = self._scene.copy(), 0, set[str]()
        for node, matrix, name in self._parts:
            mesh = self._scene.geometry[name].copy(include_cache=True)
            normals = mesh.vertex_normals if "vertex_normals" in mesh._cache else None
            rows = slice(begin, begin + len(mesh.vertices))
            begin, back = rows.stop, np.linalg.inv(matrix)
            mesh.vertices = trimesh.transform_points(positions[rows], back)
            if normals is not None:
                L = matrix[:3, :3]
                turn = L.T @ rotations[rows] @ back[:3, :3].T
                mesh.vertex_normals = (turn @ normals[..., None])[..., 0]
            own = name if name not in used else f"{name} {node}"
            used.add(own)
            scene.geometry[own] = mesh
            graph = scene.graph
            parent = graph.transforms.parents[node]
            graph.update(node, parent, matrix=graph.get(node, parent)[0], geometry=own)
        _export(scene, path)


def write_surface(path: Path, points: np.ndarray, triangles: np.ndarray) -> None:
    """Write positions (n,3) and triangles (m,3) as a file with one mesh."""
    _export(trimesh.Scene(trimesh.Trimesh(points, triangles, process=False)), path)


def _export(scene: Any, path: Path) -> None:
    if path.suffix.lower() == ".gltf":
        files = gltf.export_gltf(scene, embed_buffers=True)  # else there are several
        path.write_bytes(files["model.gltf"])
    else:
        path.write_bytes(gltf.export_glb(scene))
