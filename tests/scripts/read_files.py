# SPDX-License-Identifier: GPL-3.0-or-later
"""Run by tests: read files with Blender's plain importers and pickle what is in them."""

import pickle
import sys
from pathlib import Path

import bpy
import numpy as np


def read(path):
    """Return {object name: (positions, faces, matrix, modifiers)} of a mesh file, or pixels."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    suffix = Path(path).suffix
    if suffix == ".png":
        return _pixels(path)
    _import(path, suffix)
    bpy.context.view_layer.update()
    return {
        obj.name: (
            _positions(obj.data),
            [tuple(np.array(face.vertices).tolist()) for face in obj.data.polygons],
            np.array(obj.matrix_world),
            [modifier.type for modifier in obj.modifiers],
        )
        for obj in bpy.data.objects
        if isinstance(obj.data, bpy.types.Mesh)
    }


def _import(path, suffix):
    wm = bpy.ops.wm
    importers = {
        ".ply": wm.ply_import,
        ".abc": wm.alembic_import,
        ".obj": wm.obj_import,
        ".blend": wm.open_mainfile,
        ".fbx": bpy.ops.import_scene.fbx,
    }
    importers.get(suffix, wm.usd_import)(filepath=path)


def _positions(mesh):
    positions = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.attributes["position"].data.foreach_get("vector", positions.ravel())
    return positions


def _pixels(path):
    """(height, width, 4) display values from 0 to 1, top row first."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"  # pyright: ignore[reportAttributeAccessIssue]
    width, height = np.array(image.size)
    pixels = np.empty((height, width, 4), np.float32)
    image.pixels.foreach_get(pixels.ravel())
    return pixels[::-1]


def main():
    target, *files = sys.argv[1:]
    Path(target).write_bytes(pickle.dumps({file: read(file) for file in files}))
