# SPDX-License-Identifier: GPL-3.0-or-later
"""How normal maps are baked: properties of the scene."""

import bpy
from bpy.props import IntProperty, PointerProperty

PROPERTY = "cubic_craft_normal_map"
"""name of the property of scenes"""


class NormalMapProperties:
    """What the panel and the operator share."""

    triangles: IntProperty(
        name="Triangles",
        description="Largest number of triangles of the low-poly mesh, approximately",
        default=1000,
        min=12,
        max=10_000_000,
        soft_max=100_000,
        options=set(),
    )
    resolution: IntProperty(
        name="Resolution",
        description="Width and height of the normal map",
        subtype="PIXEL",
        default=1024,
        min=64,
        max=8192,
        options=set(),
    )


class CubicCraftNormalMap(NormalMapProperties, bpy.types.PropertyGroup):
    """The settings of Bake Normal Map, of a scene."""


def normal_map_properties(scene: bpy.types.Scene) -> CubicCraftNormalMap:
    """Return the settings of a scene."""
    return getattr(scene, PROPERTY)


def register():
    """Add the properties."""
    bpy.utils.register_class(CubicCraftNormalMap)
    setattr(bpy.types.Scene, PROPERTY, PointerProperty(type=CubicCraftNormalMap))


def unregister():
    """Remove them."""
    delattr(bpy.types.Scene, PROPERTY)
    bpy.utils.unregister_class(CubicCraftNormalMap)
