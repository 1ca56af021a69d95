# SPDX-License-Identifier: GPL-3.0-or-later
"""Run by a fixture: write the awkward mesh in every format, with Blender alone.

The vertices of the mesh are numbered so that any reordering shows, and it has quads, triangles, an
n-gon, UV seams, and loose vertices at the start, in the middle and at the end.
"""

import os
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler, Matrix

POSITIONS = np.array(
    [
        [7, 7, 7],  # loose
        [0, 0, 0],
        [1, 0, 0],
        [1, 1.1, 0],
        [0, 1, 0],
        [8, 8.123456, 8],  # loose
        [0, 0, 1],
        [1.2345678, 0, 1],
        [1, 1, 1],
        [0, 1.3, 1],
        [0.5, 1.6, 0.5],
        [9, 9, 9],  # loose
    ],
    np.float32,
)
FACES = [
    (1, 4, 3, 2),
    (6, 7, 8, 9),
    (1, 2, 7, 6),
    (2, 3, 8, 7),
    (4, 1, 6, 9, 10),
    (3, 4, 10),
    (9, 8, 10),
    (8, 3, 10),
]
TINY = np.float32(1e-5)
PLACE = Matrix.LocRotScale((1, 2, 3), Euler((0.3, 0.2, 0.1)), (2.0, 0.5, 1.0))


def awkward_mesh():
    mesh = bpy.data.meshes.new("awkward")
    mesh.from_pydata((POSITIONS * TINY).tolist(), [], FACES)
    layer = mesh.uv_layers.new(name="UVMap")
    uvs = np.random.default_rng(0).random(len(mesh.loops) * 2).astype(np.float32)
    layer.uv.foreach_set("vector", uvs)
    return mesh


def write_obj(path):
    """By hand: Blender's exporter would round the coordinates away."""
    lines = [f"v {' '.join(str(number) for number in row)}" for row in POSITIONS * TINY]
    lines += [f"vt {number / 40} {number % 7 / 7}" for number in range(30)]
    corner = 0
    for face in FACES:
        words = [f"{vertex + 1}/{corner + n + 1}" for n, vertex in enumerate(face)]
        lines.append(f"f {' '.join(words)}")
        corner += len(face)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main(folder):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    obj = bpy.data.objects.new("awkward", awkward_mesh())
    obj.vertex_groups.new(name="pinned").add([1, 2, 3, 4], 1.0, "REPLACE")
    obj.vertex_groups.new(name="light").add([1, 2, 3, 4], 0.25, "REPLACE")
    bpy.context.collection.objects.link(obj)
    obj.matrix_world = PLACE
    bpy.context.view_layer.update()
    target = str(folder / "awkward")
    bpy.ops.wm.ply_export(filepath=target + ".ply", export_uv=False)
    bpy.ops.wm.alembic_export(filepath=target + ".abc")
    for suffix in (".usd", ".usda", ".usdc", ".usdz"):
        bpy.ops.wm.usd_export(filepath=target + suffix)
    bpy.ops.export_scene.gltf(filepath=target + ".glb")
    bpy.ops.export_scene.fbx(filepath=target + ".fbx")
    bpy.ops.wm.stl_export(filepath=target + ".stl")
    twin = bpy.data.objects.new("twin", obj.data)
    bpy.context.collection.objects.link(twin)
    obj.modifiers.new("Subdivision", "SUBSURF")
    bpy.ops.wm.save_as_mainfile(filepath=target + ".blend")
    write_obj(folder / "awkward.obj")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
    # Blender 4.2 crashes at its end after a glTF export.
    sys.stdout.flush()
    os._exit(0)
