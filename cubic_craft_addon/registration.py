# SPDX-License-Identifier: GPL-3.0-or-later
"""Registers the Blender side that is not an operator."""

from . import hidden_source, job, live, presets
from .animation import properties as animation_properties
from .command_line import blender_command
from .environment import ahead, kept
from .form import overlay as form_overlay
from .form import pictures as form_pictures
from .handles import gizmos as handle_gizmos
from .handles import overlay as handles_overlay
from .handles import properties as handles_properties
from .regions import region
from .send import properties as send_properties
from .settings import group_renames, properties
from .ui import group_list, header, menus, panel, preferences

_modules = (
    handles_properties,
    form_pictures,
    region,
    properties,
    animation_properties.bake_settings,
    animation_properties,
    hidden_source,
    send_properties.normal_map_settings,
    preferences,
    live,
    job,
    kept,
    handle_gizmos,
    handles_overlay,
    form_overlay,
    group_list,
    presets,
    panel,
    menus,
    header,
    group_renames,
    ahead,
    blender_command,
)


def register():
    """Register all modules."""
    for module in _modules:
        if hasattr(module, "register"):  # some only have something to end
            module.register()


def unregister():
    """Unregister all modules, in reverse order."""
    for module in reversed(_modules):
        module.unregister()
