# SPDX-License-Identifier: GPL-3.0-or-later
"""Which frames are baked, and where to: properties of the scene."""

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty, StringProperty

PROPERTY = "cubic_craft_animation"
"""name of the property of scenes"""
SOURCE = "cubic_craft_source"
"""name of the property of baked objects: what they were baked from"""

_FORMATS = (
    (
        "CACHE",
        "Point Cache",
        "A PC2 file with the positions of all frames, which a Mesh Cache modifier plays back",
    ),
    (
        "ALEMBIC",
        "Alembic",
        "An Alembic file for other programs too, which a Mesh Sequence Cache modifier plays back",
    ),
    (
        "USD",
        "USD",
        "A USD file for other programs too, which a Mesh Sequence Cache modifier plays back",
    ),
    (
        "SHAPE_KEYS",
        "Shape Keys",
        "Absolute shape keys in the .blend file, one for each frame; for short animations",
    ),
)

# Blender 5 warns of a path with // in a property that does not say so; 4.2 does not know the word.
_RELATIVE: set[Any] = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (5, 0) else set()


class BakeProperties:
    """What the panel and the operator share."""

    use_range: BoolProperty(
        name="Own Range",
        description="Bake from Start to End, instead of the frames of the scene",
        default=False,
        options=set(),
    )
    frame_start: IntProperty(
        name="Start",
        description="First frame to bake",
        default=1,
        min=-1048574,
        max=1048574,
        options=set(),
    )
    frame_end: IntProperty(
        name="End",
        description="Last frame to bake",
        default=250,
        min=-1048574,
        max=1048574,
        options=set(),
    )
    format: EnumProperty(
        name="Format",
        description="How the baked frames are stored",
        items=_FORMATS,
        default="CACHE",
        options=set(),
    )
    folder: StringProperty(
        name="Folder",
        description="Where the files of baked frames are stored; // is the folder of the .blend"
        " file",
        subtype="DIR_PATH",
        default="//cubic_craft",
        options=_RELATIVE,
    )


class CubicCraftAnimation(BakeProperties, bpy.types.PropertyGroup):
    """The settings of Cubify Animation, of a scene."""


def bake_properties(scene: bpy.types.Scene) -> CubicCraftAnimation:
    """Return the settings of a scene."""
    return getattr(scene, PROPERTY)


def source_of(obj: bpy.types.Object) -> bpy.types.Object:
    """Return what a baked object was baked from, or the object itself."""
    return getattr(obj, SOURCE) or obj


def register():
    """Add the properties."""
    bpy.utils.register_class(CubicCraftAnimation)
    setattr(bpy.types.Scene, PROPERTY, PointerProperty(type=CubicCraftAnimation))
    setattr(bpy.types.Object, SOURCE, PointerProperty(type=bpy.types.Object, options={"HIDDEN"}))


def unregister():
    """Remove them."""
    delattr(bpy.types.Object, SOURCE)
    delattr(bpy.types.Scene, PROPERTY)
    bpy.utils.unregister_class(CubicCraftAnimation)
