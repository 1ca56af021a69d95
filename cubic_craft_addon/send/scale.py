# SPDX-License-Identifier: GPL-3.0-or-later
"""How large a print becomes."""

import bpy

from .file import extent

_MILLIMETERS = 1000.0  # in a meter
SCALES = (
    ("SCENE", "Scene Unit", "As large as in the scene: a meter becomes 1000 mm"),
    ("MILLIMETERS", "Millimeters", "A unit of Blender becomes a millimeter"),
    ("SIZE", "Longest Side", "The longest side of everything that is written has a given length"),
)


def scale_of(
    scale: str, size: float, scene: bpy.types.Scene, objects: list[bpy.types.Object]
) -> float:
    """Return how many millimeters a unit of Blender becomes.

    `scale`: one of `SCALES`. `size`: length of the longest side in millimeters, for SIZE. `scene`:
    it has the units. `objects`: all that are written.
    """
    if scale == "SIZE":
        return size / max(extent(objects), 1e-12)
    if scale == "MILLIMETERS":
        return 1.0
    units = scene.unit_settings
    return _MILLIMETERS * (units.scale_length if units.system != "NONE" else 1.0)
