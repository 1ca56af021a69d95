# SPDX-License-Identifier: GPL-3.0-or-later
"""An overlay in the viewport: the surface in the colors of its angles to the form, with a legend.

The switch is stored on the window manager, as that of the form is.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import bpy
import gpu
from bpy.props import BoolProperty
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ...solver import CubicCraftError
from .. import live
from ..environment.kept import Kept
from ..environment.requirements import check_requirements
from ..handles.owner import panel_object
from ..read.object_frame import placement_alone
from ..screen.redraw import redraw_views
from . import legend
from .measured import Angles, remaining_angles

_known: Kept[Angles] = Kept()
"""by the object, with what they were measured with as the key"""
PROPERTY = "cubic_craft_angles"
_TOWARD_VIEWER = 2e-6
"""of the depth range, so that the colors cover the surface: some steps of 24 bits"""


def angles_now(obj: bpy.types.Object) -> Angles:
    """Return the angles of a mesh object as it is seen; the same ones until they change.

    Raises CubicCraftError: SciPy is missing, the form or its orientation is not defined, because an
    object is not set, or the object has no surface.
    """
    check_requirements()
    settings = live.settings_now(obj)
    placement = placement_alone(obj, settings)
    measure = partial(remaining_angles, obj, placement, settings)
    return _known.made(obj.session_uid, measure, placement.key)


_VERTEX_SOURCE = """
void main() {
  place = pos;
  tint = color;
  gl_Position = ModelViewProjectionMatrix * vec4(pos, 1.0);
}
"""
_FRAGMENT_SOURCE = """
void main() {
  vec3 normal = normalize(NormalMatrix * cross(dFdx(place), dFdy(place)));
  normal *= normal.z < 0.0 ? -1.0 : 1.0;
  float light = max(dot(normal, normalize(vec3(-0.4, 0.5, 1.0))), 0.0);
  vec3 shaded = tint.rgb * mix(0.7, 1.0, light);
  fragColor = vec4(srgbTarget ? pow(shaded, vec3(2.2)) : shaded, tint.a);
}
"""

_handles: list[Any] = []
_shader: gpu.types.GPUShader | None = None
_drawn: tuple[Angles, gpu.types.GPUBatch] | None = None
"""the angles that are on the GPU"""


def angles_to_draw(context: bpy.types.Context) -> tuple[Any, Angles] | None:
    """Return the object that the overlay shows in a viewport, and its angles, or None.

    Only in Object Mode: other modes show something of their own on the surface.
    """
    view = context.space_data
    if not getattr(context.window_manager, PROPERTY) or not view.overlay.show_overlays:
        return None
    obj = panel_object(context)
    if obj is None or obj.mode != "OBJECT" or not obj.visible_in_viewport_get(view):
        return None
    try:
        found = angles_now(obj)
    except CubicCraftError:
        return None  # the panel shows the problem
    return (obj, found) if len(found.areas) else None


def _draw_surface():
    found = angles_to_draw(bpy.context)
    if found is None:
        return
    obj, measured = found
    shader, batch = _surface_shader(), _batch_of(measured)
    nearer = Matrix.Translation((0.0, 0.0, -_TOWARD_VIEWER))
    gpu.state.depth_test_set("LESS_EQUAL")
    gpu.state.depth_mask_set(True)
    gpu.matrix.push()
    gpu.matrix.push_projection()
    gpu.matrix.multiply_matrix(obj.matrix_world)
    gpu.matrix.load_projection_matrix(nearer @ gpu.matrix.get_projection_matrix())
    batch.draw(shader)
    gpu.matrix.pop_projection()
    gpu.matrix.pop()
    gpu.state.depth_mask_set(False)
    gpu.state.depth_test_set("NONE")


def _draw_legend():
    found = angles_to_draw(bpy.context)
    if found is not None:
        legend.draw(bpy.context, found[1].aligned)


def _batch_of(measured):
    global _drawn
    if _drawn is None or _drawn[0] is not measured:
        colors = legend.colors_of(measured.degrees).repeat(3, axis=0)
        corners: dict[str, Any] = {"pos": measured.corners.reshape(-1, 3), "color": colors}
        _drawn = measured, batch_for_shader(_surface_shader(), "TRIS", corners)
    return _drawn[1]


def _surface_shader():
    """Return the shader: flat colors, a little darker where the surface turns away from the light.

    The light is behind the viewer, above the left shoulder. Without it, sides of the same color
    could not be told apart. Blender sets the constants by their names.
    """
    global _shader
    if _shader is None:
        between = gpu.types.GPUStageInterfaceInfo("cubic_craft_angles")
        between.smooth("VEC3", "place")
        between.flat("VEC4", "tint")
        info = gpu.types.GPUShaderCreateInfo()
        info.push_constant("MAT4", "ModelViewProjectionMatrix")
        info.push_constant("MAT3", "NormalMatrix")
        info.push_constant("BOOL", "srgbTarget")
        info.vertex_in(0, "VEC3", "pos")
        info.vertex_in(1, "VEC4", "color")
        info.vertex_out(between)
        info.fragment_out(0, "VEC4", "fragColor")
        info.vertex_source(_VERTEX_SOURCE)
        info.fragment_source(_FRAGMENT_SOURCE)
        _shader = gpu.shader.create_from_info(info)
    return _shader


def _on_switch(_self, _context):
    global _drawn
    _known.forget()
    _drawn = None
    redraw_views()


def register():
    """Add the switch and the draw handlers."""
    switch = BoolProperty(
        name="Show Angles",
        description="Color the active mesh, as it is seen, by the angles between its surface and"
        " the nearest sides of the form",
        update=_on_switch,
    )
    setattr(bpy.types.WindowManager, PROPERTY, switch)
    for draw, when in ((_draw_surface, "POST_VIEW"), (_draw_legend, "POST_PIXEL")):
        _handles.append(bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", when))


def unregister():
    """Remove the draw handlers and the switch."""
    global _shader, _drawn
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")
    _shader = _drawn = None
    delattr(bpy.types.WindowManager, PROPERTY)
