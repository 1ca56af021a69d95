# SPDX-License-Identifier: GPL-3.0-or-later
"""The section "Send To" of the panel."""

import bpy

from .. import live
from .properties import normal_map_settings
from .targets import SENT, TARGETS

SECTION = "CUBIC_CRAFT_PT_send"


def draw(layout, obj):
    """Draw the section for a mesh object."""
    layout.active = live.current() is None
    column = layout.column(align=True)
    for key in SENT:
        target = TARGETS[key]
        button = column.operator("cubic_craft.send_to", text=target.button, icon=target.icon)
        button.target = key
    properties = normal_map_settings.of(bpy.context.scene)
    column = layout.column()
    column.prop(properties, "triangles")
    column.prop(properties, "resolution")
    layout.operator("cubic_craft.bake_normal_map", icon="IMAGE_DATA")
