# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 2: a texture that goes along, because the UVs stay as they are.

The material reads nothing but an image, through the UVs.
"""

import bpy

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group

from .figure_meshes import FigureMeshes, colored_by

CUBENESS = 0.7
PIXELS = 2048
ROUGHNESS = 0.5


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return a mesh with Blender's own test grid, before and after."""
    (model,) = meshes.there(["spot"], instead=["monkey"])
    shape = meshes.cubified(model, CUBENESS)
    grid = bpy.data.images.new("Grid", PIXELS, PIXELS)
    grid.generated_type = "COLOR_GRID"
    grid.pack()
    material = colored_by("ShaderNodeTexImage", ROUGHNESS, image=grid)
    groups = []
    for positions, label in ((model.original, "original"), (shape, f"cubeness {CUBENESS:g}")):
        group = meshes.group(model, positions, label, "grey")
        group.copies[0].data.materials.clear()
        group.copies[0].data.materials.append(material)
        groups.append(group)
    return groups
