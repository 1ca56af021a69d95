# SPDX-License-Identifier: GPL-3.0-or-later
"""A cubic mesh, and its low-poly version without and with the normal map."""

from typing import Any

import bpy

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.command_line.picture.studio import FINISHES, surface
from cubic_craft.cubic_craft_addon.command_line.process.quiet import captured

from .figure_meshes import FigureMeshes, Model

CUBENESS = 0.4
TRIANGLES = 1000
ROUGH_PIXELS = 128
"""of a side of the map"""


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the result, the low-poly mesh, and the same with the map."""
    (model,) = meshes.there([], instead=["monkey"])
    positions = meshes.cubified(model, CUBENESS)
    low = _low_poly(meshes, model)
    triangles = len(low.data.polygons)
    plain: Any = low.copy()
    plain.data = low.data.copy()
    material: Any = surface("Plain", *FINISHES["green"])
    for number in range(len(plain.data.materials)):
        plain.data.materials[number] = material
    groups = [meshes.group(model, positions, f"{len(positions):,} vertices", "green")]
    for copy, label in ((plain, f"{triangles:,} triangles"), (low, "with the normal map")):
        group = meshes.group(model, positions, label, "green")
        bpy.data.objects.remove(group.copies[0])
        group.copies[0] = copy
        groups.append(group)
    return groups


def _low_poly(meshes: FigureMeshes, model: Model) -> bpy.types.Object:
    """Return the low-poly version of a cubic mesh, in no scene, with its map and no modifiers."""
    bpy.context.window.scene = model.scene
    obj = model.object
    obj.data.materials.append(surface("Green", *FINISHES["green"]))
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    operators: Any = bpy.ops.cubic_craft
    size = {"resolution": ROUGH_PIXELS} if meshes.is_rough else {}
    with captured():
        operators.cubify(cubeness=CUBENESS, space="OBJECT", **meshes.limit)
        operators.bake_normal_map(triangles=TRIANGLES, **size)
        low = bpy.context.object
        operators.show_source()
        model.scene.collection.objects.unlink(low)
        obj.select_set(True)
        bpy.context.view_layer.objects.active = obj
        operators.restore()
    obj.data.materials.clear()
    return low
