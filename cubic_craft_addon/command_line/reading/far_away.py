# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes far from the origin, such as houses in the coordinates of their country.

Blender has 32 bits for a coordinate, so its importers round.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

from ...mesh_bridge import read_position

FAR = 1000.0
"""times its largest extent: there 32 bits round to 6e-5 of the extent"""


def warn_if_rounded(path: Path, objects: list[bpy.types.Object]) -> None:
    """Say in one line that meshes are so far from their origins that their shapes were rounded."""
    boxes = [(p.min(axis=0), p.max(axis=0)) for o in objects if len(p := read_position(o.data))]
    extent = max((float((high - low).max()) for low, high in boxes), default=0.0)
    away = max((float(np.abs(low + high).max()) / 2 for low, high in boxes), default=0.0)
    if away > FAR * extent > 0.0:
        print(
            f"{path}: lies {away:.3g} from its origin, where Blender rounds coordinates to "
            f"{np.spacing(np.float32(away)):.2g}; move it to the origin",
            file=sys.stderr,
        )
