# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 2: a texture that goes along, because the UVs stay as they are.

The material of all four meshes reads nothing but an image, through the UVs.
"""

import bpy
from headless.gallery import Group
from headless.studio import surface

from .figure_meshes import FigureMeshes, Model
from .hide import painted_hide
from .picture import Picture, side_by_side

__all__ = ("compose",)

CUBENESS = 0.7
GRID_PIXELS = 2048
ROUGHNESS = 0.5
HEIGHT = 560
"""pixels"""


def compose(meshes: FigureMeshes) -> Picture:
    """Show a painted mesh and one with a grid, each before and after."""
    (model,) = meshes.there(["spot"], instead=["monkey"])
    shape = meshes.cubified(model, CUBENESS)
    groups: list[Group] = []
    for image, name in ((painted_hide(model), "painted"), (_grid(), "grid")):
        material = _textured(image)
        for positions, label in ((model.original, name), (shape, f"{name}, cubeness {CUBENESS:g}")):
            groups.append(_dressed(meshes, model, positions, label, material))
    return side_by_side(groups, HEIGHT)


def _dressed(
    meshes: FigureMeshes, model: Model, positions, label: str, material: bpy.types.Material
) -> Group:
    group = meshes.group(model, positions, label, "grey")
    mesh = group.copies[0].data
    mesh.materials.clear()
    mesh.materials.append(material)
    return group


def _grid() -> bpy.types.Image:
    """Return Blender's own coloured test grid."""
    image = bpy.data.images.new("Grid", GRID_PIXELS, GRID_PIXELS)
    image.generated_type = "COLOR_GRID"
    image.pack()
    return image


def _textured(image: bpy.types.Image) -> bpy.types.Material:
    """Return a material that shows an image through the active UV map."""
    material = surface(image.name, (1.0, 1.0, 1.0), ROUGHNESS)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    links.new(texture.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return material
