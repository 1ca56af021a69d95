# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an object keeps its settings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

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


def active_entry(obj: Any, kind: str) -> Any:
    """Return what is active in the list of an object, or None; `kind`: "handle" or "region"."""
    properties = object_properties(obj)
    entries, number = getattr(properties, f"{kind}s"), getattr(properties, f"active_{kind}")
    return entries[number] if number < len(entries) else None


def remove_active(obj: Any, kind: str) -> None:
    """Remove what is active in a list of an object; `kind` as of `active_entry`."""
    properties = object_properties(obj)
    entries, number = getattr(properties, f"{kind}s"), getattr(properties, f"active_{kind}")
    entries.remove(number)
    setattr(properties, f"active_{kind}", max(min(number, len(entries) - 1), 0))


def users_of(meshes: Iterable[bpy.types.Mesh]) -> Iterator[bpy.types.Object]:
    """Give the objects that show any of the meshes and can have other settings, each once."""
    found = bpy.data.user_map(subset=list(meshes)).values()
    for user in set().union(*found):
        if isinstance(user, bpy.types.Object) and user.is_editable:
            yield user
