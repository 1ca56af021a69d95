# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a follower stands: beside the original, so that neither hides the other from the view."""

from collections.abc import Iterable
from typing import Any

import bpy
import numpy as np
from mathutils import Vector

from ..environment.curves import animated_paths

_GAP, _NEAR = 1.2, 0.1  # of the width of the originals
_LEAST_LEVEL = 0.5  # of the view's right, which has no height unless the view is rolled
_STEP, _FARTHEST = 1.1, 4.0  # by which a view in perspective asks for a larger gap
_DEFORMING_PARENTS = ("ARMATURE", "LATTICE", "CURVE")
MODIFIER = "Beside"
"""name of the modifiers that show a follower beside its own place"""


def shift_beside(objects: Iterable[bpy.types.Object]) -> Vector:
    """Return the way in world space from objects to where copies of all of them are seen beside.

    To the right in the view that the artist looks at, and along X where there is no window.
    """
    corners = np.array([obj.matrix_world @ Vector(c) for obj in objects for c in obj.bound_box])
    view = _view()
    right = np.array((1.0, 0.0, 0.0) if view is None else view.view_matrix[0][:3])
    way = right * (1.0, 1.0, 0.0)
    if np.linalg.norm(way) < _LEAST_LEVEL:
        way = right
    way = way / np.linalg.norm(way)
    shift = way * (_GAP * np.ptp(corners @ right) / (way @ right))
    if view is not None:
        farthest = _FARTHEST * np.linalg.norm(shift)
        while np.linalg.norm(shift) < farthest and _is_hidden(view, corners, corners + shift):
            shift = _STEP * shift
    return Vector(shift.tolist())


def put_beside(obj: bpy.types.Object, source: bpy.types.Object, shift: Vector) -> None:
    """Put an object beside the one that it is a copy of, whatever moves and deforms that one."""
    if _is_deformed_by_others(obj):
        _show_beside(obj, source, shift)
        return
    world = source.matrix_world.copy()
    world.translation += shift
    if "location" in animated_paths(source):  # the delta is added to what the animation says
        space = source.matrix_world @ source.matrix_basis.inverted_safe()
        obj.delta_location += space.to_3x3().inverted_safe() @ shift
    else:
        obj.matrix_world = world
    bpy.context.view_layer.update()
    if (obj.matrix_world.translation - world.translation).length > _NEAR * shift.length:
        obj.constraints.clear()
        obj.matrix_world = world


def _show_beside(obj, source, shift):
    """Leave an object in the place of the source, and move what is seen of it.

    In another place, an armature, a hook or a mirror object would give it another shape.
    """
    linear = source.matrix_world.to_3x3()
    # Blender takes the global axes to the object by the transpose, not the inverse.
    strengths = (linear @ linear.transposed()).inverted_safe() @ shift
    for axis, strength in zip("XYZ", strengths, strict=True):
        if abs(strength) > 1e-6 * strengths.length:
            modifier: Any = obj.modifiers.new(MODIFIER, "DISPLACE")
            modifier.direction, modifier.space = axis, "GLOBAL"
            modifier.mid_level, modifier.strength = 0.0, strength


def _is_deformed_by_others(obj):
    is_by_parent = obj.parent is not None and obj.parent_type in _DEFORMING_PARENTS
    return is_by_parent or any(_refers_to_others(modifier) for modifier in obj.modifiers)


def _refers_to_others(modifier):
    values = [
        getattr(modifier, prop.identifier)
        for prop in modifier.bl_rna.properties
        if prop.type == "POINTER"
    ]
    if modifier.type == "NODES":
        values += _given_to_nodes(modifier)
        values += _named_in(modifier.node_group)
    return any(isinstance(value, bpy.types.Object | bpy.types.Collection) for value in values)


def _given_to_nodes(modifier):
    """Return what the sockets of a node group get: before Blender 5.3, custom properties."""
    if not hasattr(modifier, "properties"):
        return [modifier.get(key) for key in modifier.keys()]  # noqa: SIM118 - of a modifier
    sockets = modifier.properties.inputs
    names = sockets.bl_rna.properties.keys() if sockets is not None else ()
    return [getattr(getattr(sockets, name), "value", None) for name in names]


def _named_in(tree):
    """Yield what the sockets of a node group, and of the groups in it, name."""
    for node in tree.nodes if tree is not None else ():
        yield from (getattr(socket, "default_value", None) for socket in node.inputs)
        yield from _named_in(getattr(node, "node_tree", None))


def _view() -> Any:
    """Return the view that the artist looks at: that of the context, or the largest one."""
    context: Any = bpy.context
    if bpy.app.background or context.window is None:
        return None
    areas = [area for area in context.window.screen.areas if area.type == "VIEW_3D"]
    if context.area in areas:
        areas = [context.area]
    largest: Any = max(areas, key=lambda area: area.width * area.height, default=None)
    return largest and largest.spaces.active.region_3d


def _is_hidden(view, one, other):
    """Return whether points (n,3) and others to the right of them overlap from left to right."""
    places = [_seen_at(view, points) for points in (one, other)]
    return all(x is not None for x in places) and places[1].min() <= places[0].max()


def _seen_at(view, points):
    """Return the places of points (n,3) from left to right; None if one is behind the view."""
    seen = np.c_[points, np.ones(len(points))] @ np.array(view.perspective_matrix).T
    return seen[:, 0] / seen[:, 3] if (seen[:, 3] > 0).all() else None
