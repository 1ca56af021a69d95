# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertex groups to arrays."""

from collections.abc import Iterable

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .checks import mesh_of


def vertex_group(obj: bpy.types.Object, name: str) -> bpy.types.VertexGroup:
    """Return the vertex group of that name.

    Raises CubicCraftError: the object has no such group.
    """
    group = obj.vertex_groups.get(name)
    if group is None:
        raise CubicCraftError(f'"{obj.name}" has no vertex group "{name}"; pick another one')
    return group


def group_weights(obj: bpy.types.Object, name: str) -> np.ndarray:
    """Read the weights of a vertex group.

    Returns (n,), 0 for vertices that are not in the group. Raises CubicCraftError: the object has
    no such group.
    """
    return weights_of_groups(obj, [name])[name]


def weights_of_groups(obj: bpy.types.Object, names: Iterable[str]) -> dict[str, np.ndarray]:
    """Read the weights of several vertex groups, by their names, in the time of one.

    Raises CubicCraftError: the object has no group of one of the names.
    """
    vertices = mesh_of(obj).vertices
    weights = {name: np.zeros(len(vertices)) for name in names}
    by_index = {vertex_group(obj, name).index: found for name, found in weights.items()}
    if not by_index:
        return weights
    # Blender offers no array access to weights; this loop is as fast as going through bmesh.
    for vertex in vertices:
        for element in vertex.groups:
            found = by_index.get(element.group)
            if found is not None:
                found[vertex.index] = element.weight
    return weights
