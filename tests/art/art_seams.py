# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as game engines have them: cut open along UV seams, or into single faces."""

import contextlib
import io
import tempfile
from pathlib import Path

import bpy
from art_objects import select


def through_glb(objects):
    """Export the objects to a .glb, remove them, and return what is imported, nothing merged.

    The file has one normal and one UV per vertex: where a corner of a face has others, the vertex
    comes back several times.
    """
    select(objects)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "mesh.glb")
        with contextlib.redirect_stdout(io.StringIO()):
            bpy.ops.export_scene.gltf(filepath=path, use_selection=True)
            for obj in objects:
                bpy.data.objects.remove(obj)
            bpy.ops.import_scene.gltf(filepath=path, merge_vertices=False)
    return [obj for obj in bpy.context.selected_objects if obj.type == "MESH"]


def with_seams(objects):
    """Return the objects as a .glb gives them, with UV islands of at most 66 degrees."""
    select(objects)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project()
    bpy.ops.object.mode_set(mode="OBJECT")
    return through_glb(objects)


def flat_shaded(objects):
    """Return the objects as a .glb gives them where each face has its own normal."""
    for obj in objects:
        obj.data.shade_flat()
    return through_glb(objects)
