# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertex groups to arrays."""

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .checks import mesh_of


def vertex_group(obj: bpy.types.Object, name: str) -> bpy.types.VertexGroup:
    """Return the vertex group of that name.

    Raises
    ------
    CubicCraftError
        The object has no such group.
    """
    group = obj.vertex_groups.get(name)
    if group is None:
        raise CubicCraftError(f'"{obj.name}" has no vertex group "{name}"; pick another one')
    return group


def group_weights(obj: bpy.types.Object, name: str) -> np.ndarray:
    """Read the weights of a vertex group.

    Returns
    -------
    (n,) numpy float64 array, 0 for vertices that are not in the group

    Raises
    ------
    CubicCraftError
        The object has no such group.
    """
    index = vertex_group(obj, name).index
    mesh = mesh_of(obj)
    weights = np.zeros(len(mesh.vertices))
    # Blender offers no array access to weights; this loop is as fast as going through bmesh.
    for vertex in mesh.vertices:
        for element in vertex.groups:
            if element.group == index:
                weights[vertex.index] = element.weight
    return weights
