# SPDX-License-Identifier: GPL-3.0-or-later
"""The section "Animation" of the panel."""

import bpy

from .. import live
from ..animation.properties import bake_properties, source_of

SECTION = "CUBIC_PT_animation"


def draw(layout, obj):
    """Draw the section for a mesh object."""
    scene = bpy.context.scene
    properties = bake_properties(scene)
    source = source_of(obj)
    if source != obj:
        layout.label(text=f"Baked from {source.name}", icon="ACTION")
    layout.prop(properties, "use_range")
    if properties.use_range:
        column = layout.column(align=True)
        column.prop(properties, "frame_start")
        column.prop(properties, "frame_end")
    layout.prop(properties, "format")
    layout.prop(properties, "folder")
    row = layout.row()
    row.enabled = live.current() is None
    row.operator("cubic_craft.bake_animation", icon="RENDER_ANIMATION")
    layout.prop(properties, "process_from")
    row = layout.row()
    row.enabled = live.current() is None
    row.operator("cubic_craft.bake_process", icon="MOD_TIME")
