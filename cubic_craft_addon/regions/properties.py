# SPDX-License-Identifier: GPL-3.0-or-later
"""The regions as Blender properties, in the list of an object."""

import bpy
from bpy.props import StringProperty

from ..form.properties import form_property
from .region import OWN


class CubicCraftRegion(bpy.types.PropertyGroup):
    """A region of an object: a vertex group with a form and a cubeness of its own."""

    __annotations__ = {
        "group": StringProperty(
            name="Vertex Group",
            description="Vertex group that the region covers. Where its weights are less than 1,"
            " the region blends into what is around it",
        )
    } | {name: form_property(name) for name in OWN}


register, unregister = bpy.utils.register_classes_factory((CubicCraftRegion,))
