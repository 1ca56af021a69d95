# SPDX-License-Identifier: GPL-3.0-or-later
"""The section "Animation" of the panel."""

from typing import Any

import bpy

from .. import live
from ..screen.text_fit import draw_wrapped
from ..ui import buttons
from .properties import bake_settings, source_of
from .sources import animated_settings

SECTION = "CUBIC_CRAFT_PT_animation"


def draw_animated(context: bpy.types.Context, layout: Any, obj: bpy.types.Object) -> None:
    """Say that a change of the frame does not move the mesh, if settings are animated."""
    names = animated_settings(obj).values()
    if not names or source_of(obj) != obj:
        return
    column = layout.box().column()
    are, them = ("is", "it") if len(names) == 1 else ("are", "them")
    text = f"{', '.join(names)} {are} animated: Cubify Animation bakes {them}"
    draw_wrapped(context, column.column(align=True), text, "INFO")
    _draw_button(column)


def draw(layout, obj):
    """Draw the section for a mesh object."""
    scene = bpy.context.scene
    properties = bake_settings.of(scene)
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
    _draw_button(layout)


def _draw_button(layout):
    row, look = layout.row(), {"text": "Cubify Animation", "icon": "RENDER_ANIMATION"}
    row.enabled = live.current() is None
    buttons.operator(row, "cubic_craft.bake_animation", **look)
