# SPDX-License-Identifier: GPL-3.0-or-later
"""The visible mesh and the one that becomes cubic: if they differ, the panel offers both."""

from dataclasses import dataclass
from typing import Any

import bpy

from .. import hidden_source, job, live, mesh_bridge
from ..object_properties import object_properties
from ..presets import panel as presets_panel
from ..read.cages import subdivision_of
from . import buttons

# Modifiers whose result differs much from the mesh.
_MAKING = {"ARRAY", "BOOLEAN", "NODES", "REMESH", "SCREW", "SKIN", "SOLIDIFY", "WIREFRAME"}
_COARSE = 2000  # vertices
MAIN = 1.5
"""height of the button to click, in those of others"""


def can_be_seen(obj: bpy.types.Object) -> bool:
    """Return whether an object may show a mesh that is not its own."""
    if obj.type not in mesh_bridge.KINDS or not obj.visible_get():
        return False
    return obj.type != "MESH" or hint_for(obj) is not None


@dataclass(frozen=True)
class Hint:
    """What is said about the modifiers, beside the offer to make cubic what they show."""

    text: str
    is_needed: bool
    """whether the cubic mesh itself will not look cubic"""


def hint_for(obj: bpy.types.Object) -> Hint | None:
    """Return what the visible mesh of an object makes of the cubic one; None if little."""
    covers = mesh_bridge.covers(obj)
    if covers:
        return Hint(f"{covers[0]} hides the result", is_needed=True)
    shown = [each for each in obj.modifiers if each.show_viewport]
    if len(mesh_bridge.mesh_of(obj).vertices) < _COARSE:
        is_fitted = object_properties(obj).refine == "AUTO" and subdivision_of(obj) is not None
        rounding = next((each for each in shown if mesh_bridge.rounds(each)), None)
        if rounding is not None and not is_fitted:
            return Hint(f"{rounding.name} will round it again", is_needed=True)
    if any(each.type in _MAKING and not mesh_bridge.only_shades(each) for each in shown):
        return Hint("Modifiers are ignored", is_needed=False)
    return None


def hint_to_draw(obj: bpy.types.Object) -> Hint | None:
    """Return the same for the panel, which has no use for it where that is asked for or runs."""
    properties = object_properties(obj)
    is_asked_for = properties.result == "NEW_OBJECT" and properties.with_modifiers
    return None if is_asked_for or live.current() or job.current() else hint_for(obj)


def draw_hint(layout: bpy.types.UILayout, hint: Hint) -> None:
    """Show that the visible mesh is not the one that becomes cubic, and offer it."""
    box = layout.box()
    box.label(text=hint.text, icon="ERROR" if hint.is_needed else "INFO")
    _draw_button(box, "Cubify What You See", is_main=hint.is_needed)


def draw_source(layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """Offer to show what the object was made from, while that is hidden behind it."""
    source = hidden_source.hidden_source(obj)
    if source is not None and not live.current():
        text = "Show in Renders" if source == obj else f"Show {source.name}"
        layout.operator("cubic_craft.show_source", text=text, icon="HIDE_ON")


def draw_other(layout: Any, obj: bpy.types.Object | None) -> None:
    """Draw the panel of an object that is not a mesh: its visible mesh becomes a new object."""
    if obj is None or obj.type not in mesh_bridge.KINDS:
        layout.label(text="Select a mesh to make cubic", icon="INFO")
        return
    draw_source(layout, obj)
    running = job.current()
    if running is not None:
        buttons.draw_progress(layout, running, lambda texts: tuple(texts)[-1])
    else:
        properties = object_properties(obj)
        presets_panel.draw(layout, properties)
        layout.prop(properties, "cubeness", slider=True)
        _draw_button(layout, "Cubify to New Mesh", is_main=True)


def _draw_button(layout, text, *, is_main):
    row = layout.row()
    row.scale_y = MAIN if is_main else 1.0
    button = row.operator("cubic_craft.cubify", text=text, icon="MESH_CUBE")
    button.result, button.with_modifiers = "NEW_OBJECT", True
