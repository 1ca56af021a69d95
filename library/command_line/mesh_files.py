# SPDX-License-Identifier: GPL-3.0-or-later
"""Read and write mesh files: .obj as text, all others through trimesh."""

import stat
from pathlib import Path

import numpy as np

from solver.console.errors import InputError

from .obj_text import ObjText
from .scene_file import SceneFile, write_surface

MeshFile = ObjText | SceneFile
_LARGEST = 1e75  # the fourth power is finite


def read(path: Path) -> MeshFile:
    """Read a file with a surface.

    Raises InputError: it is missing or cannot be read, or is no surface.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise InputError("is a device or a pipe; give a file")
        if not path.stat().st_size:
            raise InputError("the file is empty; export it again")
        file = (ObjText if path.suffix.lower() == ".obj" else SceneFile)(path)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}); check the path") from None
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
