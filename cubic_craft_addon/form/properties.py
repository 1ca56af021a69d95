# SPDX-License-Identifier: GPL-3.0-or-later
"""The properties that an object and each of its regions have: what the surface is turned toward.

Each function returns the declaration of one.
"""

import math
from typing import Any

import bpy
from bpy.props import (
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
)

from .pictures import items as form_items
from .settings import FormSettings

OPTIONS: Any = {"SKIP_SAVE", "ANIMATABLE"}


def cubeness() -> Any:
    """Return the declaration of Cubeness."""
    return FloatProperty(
        name="Cubeness",
        description="How strongly the surface turns toward the sides of the form. 0 keeps the"
        " shape, 0.1 moves it a third of the way, 0.4 most of it. You can type values beyond"
        " the slider, up to 10",
        default=FormSettings.cubeness,
        min=0.0,
        max=10.0,
        soft_max=0.5,
        step=1,
        precision=3,
        options=OPTIONS,
    )


def form() -> Any:
    """Return the declaration of Form."""
    return EnumProperty(
        name="Form",
        description="What a ball would become: the surface turns toward the sides of this form",
        items=form_items,
        default=FormSettings.form,
        options=OPTIONS,
    )


def form_sides() -> Any:
    """Return the declaration of Sides."""
    return IntProperty(
        name="Sides",
        description="Number of walls or slopes around the Z axis",
        default=FormSettings.form_sides,
        min=3,
        max=64,
        soft_max=12,
        options=OPTIONS,
    )


def form_weights() -> Any:
    """Return the declaration of Weights."""
    return FloatVectorProperty(
        name="Weights",
        description="How strongly the surface turns away from each axis of the box. (1, 1, 0) makes"
        " slabs, (0, 0, 1) upright walls",
        subtype="XYZ",
        default=FormSettings.form_weights,
        min=0.0,
        max=10.0,
        soft_max=2.0,
        options=OPTIONS,
    )


def form_object() -> Any:
    """Return the declaration of Form Object."""
    return PointerProperty(
        name="Form Object",
        description="Object that the form is made from, about its origin",
        type=bpy.types.Object,
    )


def orientation(on_change: Any = None) -> Any:
    """Return the declaration of Orientation."""
    return FloatVectorProperty(
        name="Orientation",
        description="Rotation of the form",
        subtype="EULER",
        default=FormSettings.orientation,
        soft_min=-math.pi / 4,
        soft_max=math.pi / 4,
        options=OPTIONS,
        update=on_change,
    )
