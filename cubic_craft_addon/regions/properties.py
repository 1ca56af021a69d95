# SPDX-License-Identifier: GPL-3.0-or-later
"""The regions as Blender properties, in the list of an object."""

import bpy
from bpy.props import StringProperty

from ..form import properties as form_properties


class CubicCraftRegion(bpy.types.PropertyGroup):
    """A region of an object: a vertex group with a form and a cubeness of its own."""

    group: StringProperty(
        name="Vertex Group",
        description="Vertex group that the region covers. Where its weights are less than 1, the"
        " region blends into what is around it",
    )
    cubeness: form_properties.cubeness()
    form: form_properties.form()
    form_sides: form_properties.form_sides()
    form_weights: form_properties.form_weights()
    form_object: form_properties.form_object()
    orientation: form_properties.orientation()


register, unregister = bpy.utils.register_classes_factory((CubicCraftRegion,))
