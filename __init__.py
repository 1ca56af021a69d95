# SPDX-License-Identifier: GPL-3.0-or-later
"""CubicCraft: cubic stylization of meshes, as a Blender extension."""

from . import operators
from .cubic_craft_addon import registration


def register():
    """Register the properties and panels, then the operators that they name."""
    registration.register()
    operators.register()


def unregister():
    """Undo `register`, in reverse order."""
    operators.unregister()
    registration.unregister()
