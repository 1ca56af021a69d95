# SPDX-License-Identifier: GPL-3.0-or-later
"""Limbs keep their direction: which parts of a body are limbs, and a frame of the form for each.

With one frame for all, a limb at 40 degrees swings until it lies along an axis, as that is where
its sides face the axes. If the frame of the form turns with the limb instead, the limb becomes a
box along itself, and swinging gains nothing. `Limbs` says which way each vertex lies; it is found
from the shape (`limbs_of_shape`) or known from bones. `turns` makes the frames of it.
"""

from .boxed import along_boxes
from .covering import with_coverings
from .hollows import with_hollows
from .joined import joined_limbs, placed_limbs
from .limbs import KnownLimbs, Limbs, no_limbs
from .of_bones import limbs_of_bones
from .of_shape import limbs_of_shape
from .plates import with_plates
from .shells import without_shells
from .turns import turns

__all__ = (
    "KnownLimbs",
    "Limbs",
    "along_boxes",
    "joined_limbs",
    "limbs_of_bones",
    "limbs_of_shape",
    "no_limbs",
    "placed_limbs",
    "turns",
    "with_coverings",
    "with_hollows",
    "with_plates",
    "without_shells",
)
