# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of one run as plain values, wherever they come from."""

from dataclasses import dataclass

import bpy

from .handles import Handle


@dataclass(frozen=True, kw_only=True)
class Settings:
    """What the artist has chosen for one object. The defaults are those of the panel."""

    cubeness: float = 0.4
    orientation: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Euler XYZ angles in radians"""
    space: str = "OBJECT"
    """what the angles are relative to: OBJECT, WORLD or FRAME"""
    frame: bpy.types.Object | None = None
    """the object that is the FRAME"""
    handles: tuple[Handle, ...] = ()
    """where they overlap, the first counts"""
    map_group: str = ""
    """name of the vertex group that scales the cubeness, or empty"""
    map_invert: bool = False
    result: str = "MESH"
    """MESH, SHAPE_KEY or NEW_OBJECT"""
    rotation: str = "AUTO"
    """KEEP turns each free part back as a whole at the end, FREE does not; AUTO: several parts"""
    device: str = "AUTO"
    """AUTO, CPU, GPU or NUMPY"""
    max_iterations: int = 1000
    tolerance: float = 1e-3
