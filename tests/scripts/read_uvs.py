# SPDX-License-Identifier: GPL-3.0-or-later
"""Run by tests: pickle positions and UVs of the meshes in a scene that the figures have saved."""

import pickle
import sys
from pathlib import Path

import bpy
import numpy as np


def main(path, target):
    with bpy.data.libraries.load(path) as (there, wanted):
        wanted.meshes = list(there.meshes)
    meshes = [mesh for mesh in wanted.meshes if mesh.uv_layers]
    Path(target).write_bytes(pickle.dumps([read(mesh) for mesh in meshes]))


def read(mesh):
    positions = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.attributes["position"].data.foreach_get("vector", positions.ravel())
    uvs = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers.active.uv.foreach_get("vector", uvs)
    nodes = mesh.materials[0].node_tree.nodes
    shader = nodes["Principled BSDF"].inputs["Base Color"].links[0].from_node
    return {
        "positions": positions,
        "uvs": uvs.tobytes(),
        "image": shader.type == "TEX_IMAGE" and shader.image is not None,
    }


if __name__ == "__main__":
    main(*sys.argv[1:])
