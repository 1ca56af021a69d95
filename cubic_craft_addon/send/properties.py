# SPDX-License-Identifier: GPL-3.0-or-later
"""How normal maps are baked: properties of the scene. And which object has which map."""

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty

PROPERTY = "cubic_craft_normal_map"
"""name of the property of scenes"""
IMAGE = "cubic_craft_normal_image"
"""name of the property of low-poly objects: the map that was baked for them"""

_UVS = (
    ("AUTO", "Auto", "The UV map of the mesh if no faces overlap in it, otherwise a new one"),
    ("KEEP", "Keep", "The active UV map of the mesh, even if faces overlap in it"),
    ("NEW", "New", "A new UV map, made by Smart UV Project. Those of the mesh are kept too"),
)


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
    flatten: BoolProperty(
        name="Flatten Facets",
        description="Make the sides of the low-poly mesh exactly planar before it is decimated",
        default=False,
        options=set(),
    )
    uv: EnumProperty(
        name="UV Map",
        description="Where the normal map lies on the mesh",
        items=_UVS,
        default="AUTO",
        options=set(),
    )


class CubicCraftNormalMap(NormalMapProperties, bpy.types.PropertyGroup):
    """The settings of Bake Normal Map, of a scene."""


def normal_map_properties(scene: bpy.types.Scene) -> CubicCraftNormalMap:
    """Return the settings of a scene."""
    return getattr(scene, PROPERTY)


def normal_image(obj: bpy.types.Object) -> bpy.types.Image | None:
    """Return the normal map that was baked for a low-poly object."""
    return getattr(obj, IMAGE)


def register():
    """Add the properties."""
    bpy.utils.register_class(CubicCraftNormalMap)
    setattr(bpy.types.Scene, PROPERTY, PointerProperty(type=CubicCraftNormalMap))
    setattr(bpy.types.Object, IMAGE, PointerProperty(type=bpy.types.Image, options={"HIDDEN"}))


def unregister():
    """Remove them."""
    delattr(bpy.types.Object, IMAGE)
    delattr(bpy.types.Scene, PROPERTY)
    bpy.utils.unregister_class(CubicCraftNormalMap)
