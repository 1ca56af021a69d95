# SPDX-License-Identifier: GPL-3.0-or-later
"""Close what glTF has cut open."""

import bmesh
import bpy
import numpy as np

from ...mesh_bridge import read_position, read_values


def weld(mesh: bpy.types.Mesh) -> None:
    """Join vertices with bit-identical coordinates; UVs and normals of the faces stay.

    glTF keeps one normal and one UV per vertex, so every sharp edge and every seam is cut open in
    the file, and would fall apart. The importer's own merging looks at normals, too.
    """
    positions = read_position(mesh) + np.float32(0.0)  # no -0.0, which has other bits
    keys = np.ascontiguousarray(positions).view("V12").ravel()
    _, first, place = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) == len(positions):
        return
    normals = read_values(mesh.corner_normals, "vector", width=3)
    edited = bmesh.new()
    try:
        edited.from_mesh(mesh)
        edited.verts.ensure_lookup_table()
        targets = first[place.ravel()].tolist()
        bmesh.ops.weld_verts(
            edited,
            targetmap={
                edited.verts[number]: edited.verts[target]
                for number, target in enumerate(targets)
                if number != target
            },
        )
        edited.to_mesh(mesh)
    finally:
        edited.free()
    if len(mesh.loops) == len(normals):  # no face has collapsed
        mesh.normals_split_custom_set(normals.tolist())
