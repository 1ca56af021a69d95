# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface in a file that trimesh reads: nodes, materials, textures, UVs and colors stay.

trimesh drops bones, animations and morph targets. glTF files with such are refused, as Blender's
command keeps them.
"""

from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from trimesh.exchange import gltf

from solver.console.output import InputError
from solver.console.sources import check_content
from solver.errors import CubicCraftError
from solver.meshes import placed_surface, with_positions

from .obj_text import ObjText

GLTF = (".glb", ".gltf")
_DROPPED = {b'"skins":': "bones", b'"animations":': "animations", b'"targets":': "morph targets"}
_LARGEST = 1e75  # the fourth power is finite


class SceneFile:
    """A file of any format but .obj.

    `points`: (n,3) in the coordinates of the scene, where each node shows them. `triangles`,
    `faces`: (m,3) int. Raises InputError: it has no surface that can be replaced; the message lacks
    the path.
    """

    def __init__(self, path: Path) -> None:
        kind = path.suffix.lower()
        if kind in GLTF:
            content = path.read_bytes().replace(b'" :', b'":')
            if found := [what for mark, what in _DROPPED.items() if mark in content]:
                cure = "the command of Blender keeps them, blender -c cubic_craft"
                raise InputError(f"has {' and '.join(found)}, which would be lost; {cure}")
        try:
            self._scene: Any = trimesh.load_scene(path, process=False)
            if kind == ".stl":
                self._scene.geometry = {n: _joined(m) for n, m in self._scene.geometry.items()}
            self.points, self.triangles, self._parts = placed_surface(self._scene)
        except CubicCraftError as error:
            raise InputError(str(error)) from error
        except Exception as error:  # its readers raise anything
            reason = (f"{type(error).__name__}: {error}".splitlines())[0]
            raise InputError(f"cannot be read as {kind} ({reason}); export it again") from error
        if not len(self.points):
            raise InputError("has no vertices on faces; is the file cut off? Export it again")
        if self.triangles.max(initial=-1) >= len(self.points) or self.triangles.min(initial=0) < 0:
            raise InputError(f"a face refers to a vertex not among the {len(self.points)}")
        self.faces, self.face_count = self.triangles, len(self.triangles)

    def write(self, path: Path, positions: np.ndarray, rotations: np.ndarray) -> None:
        """Write the file with other positions (n,3), and normals turned by rotations (n,3,3).

        A mesh that several nodes show becomes one for each. Of several nodes, formats without nodes
        get the surface alone.
        """
        scene = with_positions(self._scene, self._parts, positions)
        for part in self._parts:
            given, made = self._scene.geometry[part.name], scene.geometry[scene.graph[part.node][1]]
            if "vertex_normals" in given._cache:
                L = part.place[:3, :3]
                turn = L.T @ rotations[part.rows] @ np.linalg.inv(L).T
                made.vertex_normals = (turn @ given.vertex_normals[..., None])[..., 0]
        if path.suffix.lower() in GLTF:
            _export_gltf(scene, path)
        elif len(self._parts) > 1 or not np.array_equal(self._parts[0].place, np.eye(4)):
            write_surface(path, positions, self.triangles)
        else:
            made.export(path)


def write_surface(path: Path, points: np.ndarray, triangles: np.ndarray) -> None:
    """Write positions (n,3) and triangles (m,3) as a file with one mesh."""
    mesh = trimesh.Trimesh(points, triangles, process=False)
    if path.suffix.lower() in GLTF:
        _export_gltf(trimesh.Scene(mesh), path)
    else:
        mesh.export(path)


def _joined(mesh: Any) -> Any:
    """Return a mesh whose corners at the same place are one vertex, as in no .stl file."""
    points, vertex = np.unique(mesh.vertices, axis=0, return_inverse=True)
    return trimesh.Trimesh(points, vertex.ravel()[mesh.faces], process=False)


def _export_gltf(scene: Any, path: Path) -> None:
    if path.suffix.lower() == ".gltf":
        files = gltf.export_gltf(scene, embed_buffers=True)  # else there are several
        path.write_bytes(files["model.gltf"])
    else:
        path.write_bytes(gltf.export_glb(scene))


MeshFile = ObjText | SceneFile


def read(path: Path) -> MeshFile:
    """Read a file with a surface.

    Raises InputError: it is missing or cannot be read, or is no surface.
    """
    check_content(path)
    try:
        file = (ObjText if path.suffix.lower() == ".obj" else SceneFile)(path)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    sizes = np.abs(file.points).max(axis=1, initial=0.0)
    (found,) = np.nonzero((sizes > _LARGEST) & np.isfinite(sizes))
    if len(found):
        reason = f"vertex {found[0] + 1} has a coordinate of {sizes[found[0]]:.3g}"
        raise InputError(f"{path}: {reason}, which is too large; repair the file, or scale it down")
    return file


def write(file: MeshFile, path: Path, positions: np.ndarray, rotations: np.ndarray) -> list[str]:
    """Write the file with other positions, and return notes of what the format cannot hold.

    `path`: its suffix is the format. `positions`: (n,3). `rotations`: (n,3,3), what normals in the
    file are rotated by. Raises InputError: the format cannot hold the mesh; OSError: the disk is
    full, or something else is wrong with it.
    """
    is_text = path.suffix.lower() == ".obj"
    if isinstance(file, ObjText) and is_text:
        file.write(path, positions)
        return []
    with np.errstate(over="ignore"):
        if not (is_text or np.isfinite(positions.astype(np.float32)).all()):
            raise InputError("its coordinates are too large for this format; choose .obj")
    if isinstance(file, SceneFile) and not is_text:
        file.write(path, positions, rotations)
        return []
    write_surface(path, positions, file.triangles)
    if file.face_count == len(file.triangles):
        return []
    return [f"{file.face_count} faces become {len(file.triangles)} triangles"]
