# SPDX-License-Identifier: GPL-3.0-or-later
"""The modes of Blender in which meshes can be made cubic."""

import bpy

_MODES = ("OBJECT", "PAINT_WEIGHT")  # in the latter the cubeness map is painted

MESSAGE = "Switch to Object Mode first"
"""message in any other mode"""


def is_mode_usable(context: bpy.types.Context) -> bool:
    """Return whether meshes can be read and written in the current mode."""
    return context.mode in _MODES
