# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an object keeps its settings."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

if TYPE_CHECKING:
    from .settings.properties import CubicCraftProperties

PROPERTY = "cubic_craft"
"""name of the property of objects"""


def object_properties(obj: bpy.types.Object) -> CubicCraftProperties:
    """Return the settings of the object."""
    return getattr(obj, PROPERTY)


def has_properties(obj: bpy.types.Object) -> bool:
    """Return whether the object has settings of its own.

    Before Blender 5, reading the settings stores them on the object, so code that reads arbitrary
    objects must check this first.
    """
    return obj.is_property_set(PROPERTY)
