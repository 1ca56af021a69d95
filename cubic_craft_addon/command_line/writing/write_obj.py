# SPDX-License-Identifier: GPL-3.0-or-later
"""Write .obj files with full float32 precision.

Blender's own exporter prints six decimals, which ruins meshes that are small. It writes all else,
and the coordinates are replaced, and the names of objects, of which it replaces the spaces.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

from ...mesh_bridge import read_position

TO_Y_UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
"""Blender's Z-up space to that of .obj files, as Blender's exporter has it"""
SUFFIXES = {"JPEG": ".jpg", "TARGA": ".tga", "OPEN_EXR": ".exr", "TIFF": ".tif"}
"""of packed images; of others .png"""


def write_obj(
    path: Path, temporary: Path, objects: list[bpy.types.Object], export: Callable[..., Any]
) -> None:
    """Write objects, each with all its vertices in their order.

    Materials, and images that are packed, come to lie beside ``path``.

    `temporary`: where the .obj is written. `objects`: in the order in which Blender exports them.
    `export`: Blender's exporter with its settings. Raises RuntimeError: of Blender.
    """
    for image in bpy.data.images:
        if image.packed_file is not None and image.users:
            _unpack(image, path)
    export(filepath=str(temporary))
    rows = (words for obj in objects for words in _placed_positions(obj))
    names, library = (obj.name for obj in objects), path.with_suffix(".mtl")
    with temporary.open("r+b") as file:  # which is not made again if the process ends meanwhile
        lines = file.readlines()
        file.seek(0)
        for line in lines:
            if line.startswith(b"v "):
                line = b"v %s\n" % " ".join(map(str, next(rows))).encode()
            elif line.startswith(b"o "):  # where spaces are underscores
                line = b"o %s\n" % " ".join(next(names).splitlines()).encode()
            elif line.startswith(b"mtllib "):
                line = b"mtllib %s\n" % library.name.encode(errors="surrogateescape")
            file.write(line)
        file.truncate()
    materials = temporary.with_suffix(".mtl")
    if materials.is_file():
        materials.replace(library)


def _unpack(image: bpy.types.Image, path: Path) -> None:
    """Write a packed image beside the .obj, as its materials name files."""
    name = bpy.path.clean_name(Path(image.name).stem)
    own = path.with_name(f"{path.stem}_{name}{SUFFIXES.get(image.file_format, '.png')}")
    own.write_bytes(image.packed_file.data)
    image.unpack(method="REMOVE")  # Blender 4.2 names those that are packed wrongly
    image.filepath_raw = str(own.resolve())


def _placed_positions(obj: bpy.types.Object) -> np.ndarray:
    """Return (n,3) positions in the space of an .obj; if one was read, bit for bit as in it."""
    positions = read_position(obj.data)
    to_file = np.array(TO_Y_UP @ obj.matrix_world)
    if np.allclose(to_file, np.eye(4), rtol=0.0, atol=1e-6):
        return positions
    return positions.astype(np.float64) @ to_file[:3, :3].T + to_file[:3, 3]
