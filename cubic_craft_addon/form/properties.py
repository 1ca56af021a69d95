# SPDX-License-Identifier: GPL-3.0-or-later
"""The properties of Blender for what the surface is turned toward."""

from typing import Any

import bpy
from bpy.props import PointerProperty

from ...solver.method import SETTINGS
from ..environment.declared import declared
from .pictures import items as form_items


def form_property(name: str, **others: Any) -> Any:
    """Return the declaration of a setting, of an object or of a region; `others` as `declared`."""
    if name == "form_object":
        return PointerProperty(
            name="Form Object",
            description="Object that the form is made from, about its origin",
            type=bpy.types.Object,
        )
    if name == "form":
        others = {"items": form_items, **others}
    return declared(SETTINGS[name], **others)
