# SPDX-License-Identifier: GPL-3.0-or-later
"""The section "Send To" of the panel."""

import bpy

from .. import live
from .properties import normal_image, normal_map_properties
from .targets import SENT, TARGETS

SECTION = "CUBIC_CRAFT_PT_send"
_WIDTH = 8.0  # of the picture, in units of the panel


def draw(layout, obj):
    """Draw the section for a mesh object."""
    layout.active = live.current() is None
    column = layout.column(align=True)
    for key in SENT:
        target = TARGETS[key]
        button = column.operator("cubic_craft.send_to", text=target.button, icon=target.icon)
        button.target = key
    image = normal_image(obj)
    if image is not None:
        _draw_image(layout, image)
        return
    properties = normal_map_properties(bpy.context.scene)
    column = layout.column()
    column.prop(properties, "triangles")
    column.prop(properties, "resolution")
    column.prop(properties, "flatten")
    column.prop(properties, "uv")
    layout.operator("cubic_craft.bake_normal_map", icon="IMAGE_DATA")


def _draw_image(layout, image):
    """Draw the normal map of a low-poly object, and how the viewport shows it."""
    layout.label(text=image.name, icon="IMAGE_DATA")
    preview = image.preview_ensure()
    if preview is not None:
        layout.template_icon(preview.icon_id, scale=_WIDTH)
    space = bpy.context.space_data
    if isinstance(space, bpy.types.SpaceView3D):
        row = layout.row()
        row.use_property_split = False
        row.prop(space.shading, "type", expand=True, icon_only=True)
