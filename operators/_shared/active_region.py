# SPDX-License-Identifier: GPL-3.0-or-later
"""Shared by the operators on regions: the active one, and a new one."""

from typing import Any

import bpy

from ...cubic_craft_addon.object_properties import object_properties
from ...cubic_craft_addon.settings.region import OWN
from ...cubic_craft_addon.settings.values import Settings


def active_region(obj) -> Any:
    """Return the region of the object that is active in its list, or None."""
    properties = object_properties(obj)
    number = properties.active_region
    return properties.regions[number] if number < len(properties.regions) else None


def add_region(obj: bpy.types.Object, group: str, settings: Settings) -> None:
    """Add a region with these settings to the end of the object's list, and make it active."""
    properties = object_properties(obj)
    region = properties.regions.add()
    region.group = group
    for name in OWN:
        setattr(region, name, getattr(settings, name))
    properties.active_region = len(properties.regions) - 1
