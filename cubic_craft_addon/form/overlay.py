# SPDX-License-Identifier: GPL-3.0-or-later
"""An overlay in the viewport: the form that the active mesh is turned toward.

The switch is stored on the window manager, so that using it leaves no undo step. The draw handler
exists only while the extension is registered.
"""

import bpy
import gpu
import numpy as np
from bpy.props import BoolProperty
from gpu_extras.batch import batch_for_shader
from mathutils import Vector

from ...solver import CubicCraftError
from ...solver.styles.forms import cube
from .. import live
from ..form.body import form_of
from ..handles.owner import panel_object
from ..read.object_frame import world_axes
from ..screen import glimpse
from ..screen.redraw import redraw_views

PROPERTY = "cubic_craft_overlay"

_MARGIN = 1.1  # the form is larger than the object by this factor
_LINE_WIDTH = 2.0  # pixels
_EDGE_COLOR = (1.0, 1.0, 1.0, 0.35)
_AXIS_COLORS = ((0.96, 0.25, 0.33, 1.0), (0.55, 0.85, 0.15, 1.0), (0.2, 0.55, 1.0, 1.0))

_handle = None


def lines_of(obj: bpy.types.Object):
    """Return the lines of the overlay for an object.

    Returns `points`: (6 + 2e,3), world space; each two are a line: the three axes, then the edges
    of the form; `colors`: list of as many RGBA tuples. Raises CubicCraftError: the form or its
    orientation is not defined, because an object is not set.
    """
    corners = np.array([obj.matrix_world @ Vector(corner) for corner in obj.bound_box])
    center = (corners.min(axis=0) + corners.max(axis=0)) / 2
    settings = live.settings_now(obj)
    axes = world_axes(obj, settings)  # columns
    along = (corners - center) @ axes
    form = form_of(settings) or cube()
    # as large as its sides must be to have all corners inside
    size = max((along @ form.normals.T / form.offsets).max() * _MARGIN, 1e-6)
    reach = size * form.offsets.min() * axes
    points, colors = [], []
    for axis, color in zip(reach.T, _AXIS_COLORS, strict=True):
        points += [center, center + axis]
        colors += [color, color]
    ends = center + size * form.vertices[form.edges.ravel()] @ axes.T
    return np.concatenate([points, ends]), colors + [_EDGE_COLOR] * len(ends)


def _draw():
    context = bpy.context
    if not (getattr(context.window_manager, PROPERTY) or glimpse.is_seen()):
        return
    obj = panel_object(context)
    if obj is None:
        return
    if not context.space_data.overlay.show_overlays:
        return
    try:
        points, colors = lines_of(obj)
    except CubicCraftError:
        return  # the panel shows the problem
    shader = gpu.shader.from_builtin("POLYLINE_SMOOTH_COLOR")
    batch = batch_for_shader(shader, "LINES", {"pos": points.tolist(), "color": colors})
    gpu.state.blend_set("ALPHA")
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", _LINE_WIDTH * context.preferences.system.ui_scale)
    batch.draw(shader)
    gpu.state.blend_set("NONE")


def _redraw(_self, _context):
    redraw_views()


def register():
    """Add the switch and the draw handler."""
    global _handle
    switch = BoolProperty(
        name="Show Form",
        description="Draw the form of the active mesh in the viewport, even while it is not being"
        " rotated",
        update=_redraw,
    )
    setattr(bpy.types.WindowManager, PROPERTY, switch)
    _handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")


def unregister():
    """Remove the draw handler and the switch."""
    global _handle
    glimpse.forget()
    bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
    _handle = None
    delattr(bpy.types.WindowManager, PROPERTY)
