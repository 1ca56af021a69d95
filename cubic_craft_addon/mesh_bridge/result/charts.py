# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a mesh that are set apart by UVs, materials, seams or sharp edges."""

import itertools

import bpy
import numpy as np

from ....solver.mesh.components import components
from ....solver.mesh.edges import edges_of
from ..access.arrays import read_values
from ..access.sharp_edges import has_following_edges

_SAME = 1e-5  # between UVs


def charts(mesh: bpy.types.Mesh, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the chart (m,) of each triangle of a mesh, and pairs (c,2) set apart within charts.

    Faces are of one chart if they are connected over edges without seam or sharpness, at which
    they have one material and the same UVs. Vertices at the same place count as one. Faces at a
    seam that ends inside of a chart are of one chart, but set apart.

    `positions`: (n,3).
    """
    faces, size = len(mesh.polygons), read_values(mesh.polygons, "loop_total", np.int32)
    start = read_values(mesh.polygons, "loop_start", np.int32)
    vertex = read_values(mesh.loops, "vertex_index", np.int32)
    edge = read_values(mesh.loops, "edge_index", np.int32)
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
    material = read_values(mesh.polygons, "material_index", np.int32)
    is_joined = material[face[one]] == material[face[other]]
    marks = ["use_seam"]
    if not has_following_edges(mesh):  # those are between sides anyway
        marks.append("use_edge_sharp")
    for name in marks:
        is_set = read_values(mesh.edges, name, bool)[edge]
        is_joined &= ~(is_set[one] | is_set[other])
    for layer in mesh.uv_layers:
        uv = read_values(layer.uv, "vector", width=2)
        for a, b in ends:
            is_joined &= np.abs(uv[a] - uv[b]).max(axis=1, initial=0.0) < _SAME
    pairs = np.stack([face[one], face[other]], axis=1)
    chart = components(pairs[is_joined], faces)[1]
    apart = pairs[~is_joined & (chart[pairs[:, 0]] == chart[pairs[:, 1]])]
    count = size - 2  # a face of k corners has k - 2 triangles
    first = (np.cumsum(count) - count).tolist()
    within = [range(start, start + k) for start, k in zip(first, count.tolist(), strict=True)]
    cuts = [
        pair
        for one, other in apart.tolist()
        if one != other
        for pair in itertools.product(within[one], within[other])
    ]
    return np.repeat(chart, count), np.array(cuts, np.int64).reshape(-1, 2)
