# SPDX-License-Identifier: GPL-3.0-or-later
"""The visible mesh and the one that becomes cubic: if they differ, the panel offers both."""

from typing import Any

import bpy

from .. import job, live, mesh_bridge
from ..object_properties import object_properties
from . import job_progress as job_panel

# Modifiers whose result differs much from the mesh, and those for which it does on coarse meshes.
_MAKING = {"ARRAY", "BOOLEAN", "NODES", "REMESH", "SCREW", "SKIN", "SOLIDIFY", "WIREFRAME"}
_ROUNDING = {"SUBSURF", "BEVEL"}
_COARSE = 2000  # vertices
_ONLY_SHADES = ("Smooth by Angle", "Auto Smooth")  # node groups included with Blender


def can_be_seen(obj: bpy.types.Object) -> bool:
    """Return whether an object may show a mesh that is not its own."""
    if obj.type not in mesh_bridge.KINDS or not obj.visible_get():
        return False
    return obj.type != "MESH" or bool(_that_matter(obj))


def draw_hint(layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """Show that the visible mesh is not the one that becomes cubic, and offer it."""
    properties = object_properties(obj)
    is_asked_for = properties.result == "NEW_OBJECT" and properties.with_modifiers
    if is_asked_for or live.current() or job.current() or not _that_matter(obj):
        return
    box = layout.box()
    covers = mesh_bridge.covers(obj)
    if covers:
        box.label(text=f"{covers[0]} hides the result", icon="ERROR")
    else:
        box.label(text="Modifiers are ignored", icon="INFO")
    _draw_button(box, "Cubify What You See")


def draw_other(layout: Any, obj: bpy.types.Object | None) -> None:
    """Draw the panel of an object that is not a mesh: its visible mesh becomes a new object."""
    if obj is None or obj.type not in mesh_bridge.KINDS:
        layout.label(text="Select a mesh to make cubic", icon="INFO")
        return
    running = job.current()
    if running is not None:
        job_panel.draw(layout, running, lambda texts: tuple(texts)[-1])
    else:
        _draw_button(layout, "Cubify to New Mesh")


def _draw_button(layout, text):
    row = layout.row()
    row.scale_y = 1.5
    button = row.operator("cubic_craft.cubify", text=text, icon="MESH_CUBE")
    button.result, button.with_modifiers = "NEW_OBJECT", True


def _that_matter(obj):
    """Return the names of the modifiers that make the visible mesh differ, in the viewport."""
    is_coarse = len(obj.data.vertices) < _COARSE
    return mesh_bridge.covers(obj) + [
        modifier.name
        for modifier in obj.modifiers
        if modifier.show_viewport
        and (modifier.type in _MAKING or (is_coarse and modifier.type in _ROUNDING))
        and not _only_shades(modifier)
    ]


def _only_shades(modifier):
    group = modifier.node_group if modifier.type == "NODES" else None
    return modifier.type == "NODES" and (group is None or group.name.startswith(_ONLY_SHADES))
