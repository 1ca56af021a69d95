# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles: which vertices they hold, and how."""

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ...solver.errors import CubicCraftError
from ...solver.pieces.handle_pose import HandlePose
from .. import mesh_bridge

THRESHOLD = 0.5
"""default of the minimum weight that makes a vertex part of a handle"""


@dataclass(frozen=True)
class Handle(HandlePose):
    """A set of vertices that is held in place or moved as a whole, and the rest follows."""

    group: str = ""
    """name of a vertex group"""
    vertices: tuple[int, ...] | None = None
    """instead of the group: indices of vertices"""
    threshold: float = THRESHOLD

    @property
    def members(self):
        """Everything that determines which vertices belong to it and how they are held."""
        return self.group, self.vertices, self.threshold, self.is_cubic


def handle_of(obj: bpy.types.Object, handles: Sequence[Handle]) -> np.ndarray:
    """Return the number (n,) int of the handle that holds each vertex, -1 for free ones.

    Raises CubicCraftError: a vertex group or a vertex does not exist.
    """
    count = len(mesh_bridge.mesh_of(obj).vertices)
    result = np.full(count, -1)
    groups = [handle.group for handle in handles if handle.vertices is None]
    weights = mesh_bridge.weights_of_groups(obj, groups)
    for number, handle in reversed(list(enumerate(handles))):  # so that the first one counts
        result[_holds(obj, handle, weights, count)] = number
    return result


def _holds(obj, handle, weights, count):
    if handle.vertices is None:
        return weights[handle.group] >= handle.threshold
    vertices = np.asarray(handle.vertices, dtype=np.int64)
    if vertices.size and not (vertices.min() >= 0 and vertices.max() < count):
        raise CubicCraftError(
            f'a handle of "{obj.name}" lists vertex {vertices.max()}, but there are only {count}'
        )
    return vertices
