# SPDX-License-Identifier: GPL-3.0-or-later
"""CubicCraft: cubic stylization of meshes, as a Blender extension."""

from . import cubic_craft_addon, operators


def register():
    """Register the properties and panels, then the operators that they name."""
    cubic_craft_addon.register()
    operators.register()


def unregister():
    """Undo `register`, in reverse order."""
    operators.unregister()
    cubic_craft_addon.unregister()
