# SPDX-License-Identifier: GPL-3.0-or-later
"""What lies on an object without being selected with it: a shirt on a body, eyes in a head.

Boxes alone would take a floor, a room and a sword beside a hip for clothes. So most of what is worn
has to lie near the surface itself, as it is seen, and its box within that of the wearer.
"""

from typing import Any

import bpy
import numpy as np

from ...solver.errors import CubicCraftError
from .. import mesh_bridge
from ..mesh_bridge import mesh_of

_IN_BOX = 0.5
"""least part of its box that lies in the box of the wearer"""
_NEAR = 0.05
"""of the largest extent of the wearer: how far from its surface it may be"""
_MOST_NEAR = 0.7
"""least share of its vertices that lie so near"""
_SAMPLES = 48
"""vertices that are looked at"""


def worn_by(obj: bpy.types.Object) -> list[Any]:
    """Return the mesh objects that lie on another one, whether they are selected or not.

    Not those that are not to be cubified: what is hidden, also in renders, not selectable, drawn as
    lines, or refused by Cubify; nor copies of the object, such as an earlier result.
    """
    depsgraph = bpy.context.evaluated_depsgraph_get()
    wearer: Any = obj.evaluated_get(depsgraph)
    if not wearer.is_evaluated:
        return []  # it is hidden, or in another scene
    low, high = _box(wearer)
    reach = _NEAR * float((high - low).max())
    if not 0.0 < reach < np.inf:
        return []
    found = []
    for other in depsgraph.view_layer.objects:
        if other == obj or not _is_for_cubify(other) or _is_copy(other, obj):
            continue
        seen = other.evaluated_get(depsgraph)
        if _share_in_box(_box(seen), low, high) < _IN_BOX:
            continue
        if _share_near(wearer, seen, reach) >= _MOST_NEAR:
            found.append(other)
    return found


def _is_for_cubify(other):
    if other.type != "MESH" or other.hide_render or other.hide_select:
        return False
    if other.display_type not in ("SOLID", "TEXTURED"):
        return False
    try:
        mesh_bridge.check_usable(other)
    except CubicCraftError:
        return False
    return True


def _is_copy(other, obj):
    mesh, own = mesh_of(other), mesh_of(obj)
    counts = [(len(each.vertices), len(each.loops)) for each in (mesh, own)]
    return counts[0] == counts[1]


def _box(obj):
    """Return the corners (3,) with the least and the largest coordinates in the world."""
    corners = np.array(obj.bound_box, dtype=np.float64)
    world = np.array(obj.matrix_world, dtype=np.float64)
    corners = corners @ world[:3, :3].T + world[:3, 3]
    return corners.min(axis=0), corners.max(axis=0)


def _share_in_box(box, low, high):
    """Return which part of a box lies within another one; flat ones count by their area."""
    sizes = box[1] - box[0]
    inside = np.minimum(box[1], high) - np.maximum(box[0], low)
    if not np.isfinite(sizes).all() or (inside < 0.0).any():
        return 0.0
    is_wide = sizes > 0.0
    return float(np.prod(inside[is_wide] / sizes[is_wide]))


def _share_near(wearer, other, reach):
    vertices = other.data.vertices
    if not len(vertices) or not len(wearer.data.polygons):
        return 0.0
    own = np.array(wearer.matrix_world, dtype=np.float64)
    if not np.linalg.det(own[:3, :3]):
        return 0.0
    into_wearer = wearer.matrix_world.inverted() @ other.matrix_world
    into_world = wearer.matrix_world.to_3x3()
    numbers = np.linspace(0, len(vertices) - 1, min(_SAMPLES, len(vertices))).astype(int)
    count = 0
    for number in numbers.tolist():
        place = into_wearer @ vertices[number].co
        is_found, nearest, _, _ = wearer.closest_point_on_mesh(place)
        if is_found:
            count += (into_world @ (nearest - place)).length <= reach
    return count / len(numbers)
