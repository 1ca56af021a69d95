# SPDX-License-Identifier: GPL-3.0-or-later
"""Paint a cow's hide on a mesh, as an image that belongs to its UVs."""

import bpy
import numpy as np
from headless.quiet import captured

from .figure_meshes import Model

__all__ = ("painted_hide",)

PIXELS = 2048
MARGIN = 32
"""pixels that the paint reaches beyond the islands of the UV map, against seams"""
WHITE = (0.66, 0.60, 0.51, 1.0)
BROWN = (0.12, 0.045, 0.02, 1.0)
"""linear RGBA"""
PATCHES = 3.2
"""of the noise, along the largest side of the mesh"""
EDGE = 0.53
"""level of the noise at which a patch ends"""


def painted_hide(model: Model) -> bpy.types.Image:
    """Return an image of patches, baked from where the original lies in space to its UVs.

    Whoever shows it sees nothing of that space any more, only UVs.
    """
    image = bpy.data.images.new("Hide", PIXELS, PIXELS)
    original = model.object
    bpy.context.window.scene = model.scene
    scene = model.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 4
    kept = list(original.data.materials)
    original.data.materials.clear()
    original.data.materials.append(_patches(image, model))
    for obj in scene.objects:
        obj.select_set(obj == original)
    bpy.context.view_layer.objects.active = original
    with captured(verbose=False):
        bpy.ops.object.bake(type="EMIT", margin=MARGIN, use_clear=True)
    image.pack()
    original.data.materials.clear()
    for material in kept:
        original.data.materials.append(material)
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
