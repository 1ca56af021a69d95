# SPDX-License-Identifier: GPL-3.0-or-later
"""Rings where the handles of the active mesh are, while Live, which has dots there, does not run.

They are in the middle of the vertices as these are seen now; a pose that Cubify has still to make
does not move them. They are kept until Blender reports that the mesh has changed.
"""

from typing import Any

import bpy
import gpu
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from gpu_extras.batch import batch_for_shader
from mathutils import Vector

from ...solver import CubicCraftError
from .. import live, mesh_bridge
from ..environment.kept import FoundLater
from ..object_properties import object_properties
from ..screen.redraw import redraw_views
from . import handle_of
from .gizmos.places import middle_of
from .owner import panel_object
from .pose import live_target, object_handles

_RADIUS, _WIDTH = 8.0, 2.0  # pixels at scale 1: those of the dots in Live
_SEGMENTS = 24
_COLOR, _ACTIVE_COLOR = (1.0, 1.0, 1.0, 0.7), (1.0, 0.6, 0.15, 1.0)

_drawer: Any = None


def marked_object(context: bpy.types.Context) -> Any:
    """Return the mesh object whose handles are marked in a viewport, or None."""
    view = context.space_data
    if live.current() is not None or context.mode != "OBJECT" or not view.overlay.show_overlays:
        return None
    obj = panel_object(context)
    if obj is None or not object_properties(obj).use_handles:
        return None
    return obj if obj.visible_in_viewport_get(view) else None


def middles_of(obj: bpy.types.Object) -> dict[int, np.ndarray]:
    """Return the middle (3,) of each handle that follows nothing, in object space, by its number.

    None of those without vertices, nor any where modifiers make vertices or a group is missing.
    """
    try:
        holder = handle_of(obj, object_handles(obj))
        points, _ = mesh_bridge.read_evaluated_points(obj)
    except CubicCraftError:
        return {}  # the panel shows the problem
    if len(points) != len(holder):
        points = mesh_bridge.read_positions(mesh_bridge.mesh_of(obj))
    found = {}
    for number, handle in enumerate(object_properties(obj).handles):
        middle = middle_of(points[holder == number])
        if live_target(handle) is None and middle is not None:
            found[number] = middle
    return found


def _key_of(obj):
    handles = object_properties(obj).handles
    held = tuple((each.group, each.threshold, live_target(each) is None) for each in handles)
    return obj.mode, held


middles = FoundLater(middles_of, _key_of, redraw_views)


def _draw():
    context = bpy.context
    obj = marked_object(context)
    if obj is None or not object_properties(obj).handles:
        return
    found = middles.now(obj)
    if not found:
        return
    scale = context.preferences.system.ui_scale
    turns = np.linspace(0.0, 2 * np.pi, _SEGMENTS + 1)
    circle = _RADIUS * scale * np.column_stack((np.cos(turns), np.sin(turns), 0.0 * turns))
    active = object_properties(obj).active_handle
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    gpu.state.blend_set("ALPHA")
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", _WIDTH * scale)
    for number, middle in found.items():
        place = location_3d_to_region_2d(
            context.region, context.region_data, obj.matrix_world @ Vector(middle.tolist())
        )
        if place is None:
            continue  # behind the viewer
        ring = (circle + (place.x, place.y, 0.0)).tolist()
        shader.uniform_float("color", _ACTIVE_COLOR if number == active else _COLOR)
        batch_for_shader(shader, "LINE_STRIP", {"pos": ring}).draw(shader)
    gpu.state.blend_set("NONE")


def register():
    """Begin to draw."""
    global _drawer
    _drawer = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_PIXEL")


def unregister():
    """Draw no longer."""
    global _drawer
    bpy.types.SpaceView3D.draw_handler_remove(_drawer, "WINDOW")
    _drawer = None
