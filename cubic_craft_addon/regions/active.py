# SPDX-License-Identifier: GPL-3.0-or-later
"""The region that is active in the list of an object, and a new one."""

from typing import Any

import bpy

from ..form.settings import FormSettings
from ..object_properties import object_properties
from .region import OWN


def active_region(obj) -> Any:
    """Return the region of the object that is active in its list, or None."""
    properties = object_properties(obj)
    number = properties.active_region
    return properties.regions[number] if number < len(properties.regions) else None


def add_region(obj: bpy.types.Object, group: str, settings: FormSettings) -> None:
    """Add a region with these settings to the end of the object's list, and make it active."""
    properties = object_properties(obj)
    region = properties.regions.add()
    region.group = group
    for name in OWN:
        setattr(region, name, getattr(settings, name))
    properties.active_region = len(properties.regions) - 1
