# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blender side that is not an operator."""

from . import live, overlay, panel, preferences, presets, properties

_modules = (properties, preferences, live, overlay, presets, panel)


def register():
    """Register all modules."""
    for module in _modules:
        module.register()


def unregister():
    """Unregister all modules, in reverse order."""
    for module in reversed(_modules):
        module.unregister()
