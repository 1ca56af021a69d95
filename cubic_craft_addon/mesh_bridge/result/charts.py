# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a mesh that are set apart by UVs, materials, seams or sharp edges."""

from typing import Any

import bpy
import numpy as np

from ....solver.mesh.components import components
from ....solver.mesh.edges import edges_of


def charts(mesh: bpy.types.Mesh, positions: np.ndarray) -> np.ndarray:
    """Return the chart (m,) of each triangle of a mesh.

    Faces are of one chart if they are connected over edges without seam or sharpness, at which
    they have one material and the same UVs. Vertices at the same place count as one.

    `positions`: (n,3).
    """
    faces, size = len(mesh.polygons), _read(mesh.polygons, "loop_total", 1, np.int32)
    start = _read(mesh.polygons, "loop_start", 1, np.int32)
    vertex = _read(mesh.loops, "vertex_index", 1, np.int32)
    edge = _read(mesh.loops, "edge_index", 1, np.int32)
    face = np.repeat(np.arange(faces), size)
    following = np.arange(len(vertex)) + 1
    following[start + size - 1] = start
    place = np.unique(positions, axis=0, return_inverse=True)[1].ravel()[vertex]
    _, number = edges_of(place, place[following], len(positions))
    order = np.argsort(number, kind="stable")
    is_pair = number[order[:-1]] == number[order[1:]]
    one, other = order[:-1][is_pair], order[1:][is_pair]
    is_turned = place[one] != place[other]
    ends = [(one, np.where(is_turned, following[other], other))]
    ends.append((following[one], np.where(is_turned, other, following[other])))
    material = _read(mesh.polygons, "material_index", 1, np.int32)
    is_joined = material[face[one]] == material[face[other]]
    for name in ("use_seam", "use_edge_sharp"):
        is_set = _read(mesh.edges, name, 1, bool)[edge]
        is_joined &= ~(is_set[one] | is_set[other])
    for layer in mesh.uv_layers:
        uv = _read(layer.uv, "vector", 2, np.float32)
        for a, b in ends:
            is_joined &= np.abs(uv[a] - uv[b]).max(axis=1, initial=0.0) < _SAME
    pairs = np.stack([face[one], face[other]], axis=1)[is_joined]
    chart = components(np.empty((0, 3), np.int64), faces, pairs)[1]
    return np.repeat(chart, size - 2)  # a face of k corners has k - 2 triangles


_SAME = 1e-5  # between UVs


def _read(items: Any, name: str, width: int, kind: Any) -> Any:
    """Return a property of items as an array, (i,) or (i,width)."""
    values = np.empty(len(items) * width, kind)
    items.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)
