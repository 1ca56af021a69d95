# SPDX-License-Identifier: GPL-3.0-or-later
"""The modes of Blender in which meshes can be made cubic."""

import bpy

MODES = ("OBJECT", "WEIGHT_PAINT")
"""those of objects in which meshes can be read and written; the cubeness map is painted"""

_MODES = ("OBJECT", "PAINT_WEIGHT")  # what a context calls the same

MESSAGE = "Switch to Object Mode first"
"""message in any other mode"""


def is_mode_usable(context: bpy.types.Context) -> bool:
    """Return whether meshes can be read and written in the current mode."""
    return context.mode in _MODES
