# SPDX-License-Identifier: GPL-3.0-or-later
"""Who appears in the figures: files of a folder of meshes, and Blender's own shapes.

`homer.obj`, which the paper shows too, is left out: it is a trademarked character.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import bpy
from headless.gallery import YAW

from . import shapes

__all__ = ("FILES", "OWN_SHAPES", "Role")


@dataclass(frozen=True)
class Role:
    """How a mesh comes onto the stage."""

    file: str = ""
    """in the folder of meshes"""
    make: Callable[[], bpy.types.Object] | None = None
    """makes one of Blender's own shapes"""
    turn: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """degrees that stand it upright as it is imported"""
    yaw: float = YAW
    """radians toward the camera"""
    size: float = 1.0
    """in the gallery; by the largest extent alone, long legs would make a mesh look small"""


FILES = {
    "bunny": Role("bunny.obj", turn=(-90.0, 0.0, 0.0), size=0.95),
    "spot": Role("spot.obj", turn=(0.0, 0.0, 180.0)),
    "owl": Role("owl.obj", turn=(-90.0, 0.0, 0.0), size=1.15),
    "horse": Role("horse.ply", turn=(0.0, 0.0, 180.0), yaw=math.radians(-55.0), size=1.3),
    "armadillo": Role("armadillo.obj", turn=(0.0, 0.0, 180.0), size=1.15),
}
OWN_SHAPES = {
    "monkey": Role(make=shapes.monkey),
    "bear": Role(make=shapes.bear),
    "duck": Role(make=shapes.duck, yaw=math.radians(60.0)),
    "letter": Role(make=shapes.letter, yaw=math.radians(20.0)),
}
