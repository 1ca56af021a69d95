# SPDX-License-Identifier: GPL-3.0-or-later
"""Which frames are baked, and where to: properties of the scene."""

from dataclasses import dataclass
from typing import Any

import bpy
from bpy.props import PointerProperty

from ...solver.setting import setting
from ..environment.declared import added
from ..environment.scene_settings import SceneSettings, properties_of

SOURCE = "cubic_craft_source"
"""name of the property of baked objects: what they were baked from"""
_FRAMES = -1048574, 1048574

# Blender 5 warns of a path with // in a property that does not say so; 4.2 does not know the word.
_RELATIVE: set[Any] = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (5, 0) else set()


@dataclass(frozen=True)
class BakeSettings:
    """Which frames are baked, and where to, as it is chosen."""

    use_range: bool = setting(False)(
        "Own Range", "Bake from Start to End, instead of the frames of the scene"
    )
    frame_start: int = setting(1, limits=_FRAMES)("Start", "First frame to bake")
    frame_end: int = setting(250, limits=_FRAMES)("End", "Last frame to bake")
    format: str = setting("CACHE")(
        "Format",
        "How the baked frames are stored",
        choices={
            "CACHE": "Point Cache: A PC2 file with the positions of all frames, which a Mesh Cache"
            " modifier plays back",
            "ALEMBIC": "Alembic: An Alembic file for other programs too, which a Mesh Sequence"
            " Cache modifier plays back",
            "USD": "USD: A USD file for other programs too, which a Mesh Sequence Cache modifier"
            " plays back",
            "SHAPE_KEYS": "Shape Keys: Absolute shape keys in the .blend file, one for each frame;"
            " for short animations",
        },
    )
    folder: str = setting("//cubic_craft", subtype="DIR_PATH")(
        "Folder", "Where the files of baked frames are stored; // is the folder of the .blend file"
    )


class BakeProperties:
    """What the panel and the operator share."""

    __annotations__ = properties_of(BakeSettings, folder={"options": _RELATIVE})


class CubicCraftAnimation(BakeProperties, bpy.types.PropertyGroup):
    """The settings of Cubify Animation, of a scene."""


bake_settings = SceneSettings("cubic_craft_animation", BakeSettings, CubicCraftAnimation)


def source_of(obj: bpy.types.Object) -> bpy.types.Object:
    """Return what a baked object was baked from, or the object itself."""
    return getattr(obj, SOURCE) or obj


_source = PointerProperty(type=bpy.types.Object, options={"HIDDEN"})
register, unregister = added(bpy.types.Object, {SOURCE: _source})
