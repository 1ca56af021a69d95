# SPDX-License-Identifier: GPL-3.0-or-later
"""How normal maps are baked: properties of the scene, which the operator has, too."""

from dataclasses import dataclass

import bpy

from ...solver.setting import setting
from ..environment.scene_settings import SceneSettings, properties_of


@dataclass(frozen=True)
class MapOptions:
    """How a normal map is baked."""

    triangles: int = setting(1000, limits=(12, 10_000_000), soft=(12, 100_000))(
        "Triangles", "Largest number of triangles of the low-poly mesh, approximately"
    )
    resolution: int = setting(1024, limits=(64, 8192), subtype="PIXEL")(
        "Resolution", "Width and height of the normal map"
    )


class NormalMapProperties:
    """What the panel and the operator share."""

    __annotations__ = properties_of(MapOptions)


class CubicCraftNormalMap(NormalMapProperties, bpy.types.PropertyGroup):
    """The settings of Bake Normal Map, of a scene."""


normal_map_settings = SceneSettings("cubic_craft_normal_map", MapOptions, CubicCraftNormalMap)
