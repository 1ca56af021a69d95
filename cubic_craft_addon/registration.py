# SPDX-License-Identifier: GPL-3.0-or-later
"""Registers the Blender side that is not an operator."""

from . import handle_gizmos, hidden_source, job, live, presets
from .animation import properties as animation_properties
from .command_line import blender_command
from .environment import ahead
from .handles import properties as handles_properties
from .read import object_cache
from .send import properties as send_properties
from .settings import form_pictures, group_renames, properties, region_properties
from .ui import (
    angles,
    angles_overlay,
    edited,
    handles_panel,
    header,
    menus,
    overlay,
    panel,
    preferences,
    regions_panel,
    worn,
)

_modules = (
    handles_properties,
    form_pictures,
    region_properties,
    properties,
    animation_properties,
    hidden_source,
    send_properties,
    preferences,
    live,
    job,
    handle_gizmos,
    angles,
    angles_overlay,
    overlay,  # its lines are drawn over the colors
    handles_panel,
    regions_panel,
    presets,
    panel,
    menus,
    header,
    edited,
    worn,
    group_renames,
    object_cache,
    ahead,
    blender_command,
)


def register():
    """Register all modules."""
    for module in _modules:
        module.register()


def unregister():
    """Unregister all modules, in reverse order."""
    for module in reversed(_modules):
        module.unregister()
