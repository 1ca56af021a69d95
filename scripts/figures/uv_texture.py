# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 2: a texture that goes along, because the UVs stay as they are.

The material of all four meshes reads nothing but an image, through the UVs.
"""

import bpy
import numpy as np

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.command_line.process.quiet import captured

from .figure_meshes import FigureMeshes, Model, colored_by

CUBENESS = 0.7
PIXELS, ROUGH_PIXELS = 2048, 256
MARGIN = 1 / 64
"""of the side of the image: the paint beyond the islands of the UV map, against seams"""
WHITE = (0.66, 0.60, 0.51, 1.0)
BROWN = (0.12, 0.045, 0.02, 1.0)
"""linear RGBA"""
PATCHES = 3.2
"""of the noise, along the largest side of the mesh"""
EDGE = 0.53
"""level of the noise at which a patch ends"""
ROUGHNESS = 0.5


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return a painted mesh and one with Blender's own test grid, each before and after."""
    (model,) = meshes.there(["spot"], instead=["monkey"])
    shape = meshes.cubified(model, CUBENESS)
    pixels = ROUGH_PIXELS if meshes.is_rough else PIXELS
    grid = bpy.data.images.new("Grid", pixels, pixels)
    grid.generated_type = "COLOR_GRID"
    grid.pack()
    groups = []
    for image, name in ((_painted_hide(model, pixels), "painted"), (grid, "grid")):
        material = colored_by("ShaderNodeTexImage", ROUGHNESS, image=image)
        for positions, label in ((model.original, name), (shape, f"{name}, cubeness {CUBENESS:g}")):
            group = meshes.group(model, positions, label, "grey")
            group.copies[0].data.materials.clear()
            group.copies[0].data.materials.append(material)
            groups.append(group)
    return groups


def _painted_hide(model: Model, pixels: int) -> bpy.types.Image:
    """Return an image of a cow's patches, baked from where the original lies in space to its UVs.

    Whoever shows it sees nothing of that space any more, only UVs.
    """
    image = bpy.data.images.new("Hide", pixels, pixels)
    bpy.context.window.scene = scene = model.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples = "CPU", 4
    copy = model.object.copy()
    copy.data = model.object.data.copy()
    scene.collection.objects.link(copy)
    copy.data.materials.clear()
    copy.data.materials.append(_patches(image, model))
    bpy.ops.object.select_all(action="DESELECT")
    copy.select_set(True)
    bpy.context.view_layer.objects.active = copy
    with captured():
        bpy.ops.object.bake(type="EMIT", margin=int(MARGIN * pixels), use_clear=True)
    image.pack()
    bpy.data.meshes.remove(copy.data)  # takes the object along
    return image


def _patches(image: bpy.types.Image, model: Model) -> bpy.types.Material:
    """Return a material that emits patches, with the image as what is baked to."""
    material = bpy.data.materials.new("Patches")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    place = nodes.new("ShaderNodeTexCoord")
    noise = nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = PATCHES / float(np.ptp(model.original, axis=0).max())
    noise.inputs["Detail"].default_value = 2.0
    ramp = nodes.new("ShaderNodeValToRGB")
    white, brown = ramp.color_ramp.elements
    white.color, brown.color = WHITE, BROWN
    white.position, brown.position = EDGE, EDGE + 0.015
    light = nodes.new("ShaderNodeEmission")
    links.new(place.outputs["Object"], noise.inputs["Vector"])
    links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
    links.new(ramp.outputs["Color"], light.inputs["Color"])
    links.new(light.outputs["Emission"], nodes["Material Output"].inputs["Surface"])
    target = nodes.new("ShaderNodeTexImage")
    target.image = image
    nodes.active = target
    return material
