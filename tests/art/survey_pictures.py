# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of a case before and after, in the studio of the command line."""

from argparse import Namespace
from pathlib import Path

import bpy
import numpy as np
from art_objects import material
from mathutils import Matrix

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import (
    Group,
    arrange,
    extent_of,
    scene_for_gallery,
)
from cubic_craft.cubic_craft_addon.command_line.picture.render import render as render_gallery
from cubic_craft.cubic_craft_addon.command_line.picture.studio import furnish

RESOLUTION = (1000, 520)
SAMPLES = 8


def render(objects, outcome, path: Path):
    """Write a picture of the objects at rest and as they are now."""
    scene = scene_for_gallery()
    size = extent_of(outcome.rest.V)
    groups = [
        Group(
            label,
            _copies(objects, surface, scene),
            [Matrix()] * len(objects),
            surface.V,
            size,
            finish,
        )
        for label, surface, finish in (
            ("before", outcome.rest, "clay"),
            ("after", outcome.after, "teal"),
        )
    ]
    bpy.context.view_layer.update()
    gallery = arrange(groups, scene, RESOLUTION)
    furnish(gallery, RESOLUTION[0] / RESOLUTION[1])
    path.parent.mkdir(parents=True, exist_ok=True)
    options = Namespace(
        engine="cycles",
        resolution=RESOLUTION,
        samples=SAMPLES,
        threads=0,
        turntable=0,
        verbose=False,
    )
    list(render_gallery(gallery, [path], options))


def _copies(objects, surface, scene):
    """Return copies with the surface's positions in world space."""
    copies = []
    for number, obj in enumerate(objects):
        mesh = obj.data.copy()
        if len(objects) > 1 and not mesh.materials:
            mesh.materials.append(material(number))
        V = surface.V[surface.owner == number].astype(np.float32)
        mesh.vertices.foreach_set("co", V.ravel())
        mesh.update()
        copy = bpy.data.objects.new(obj.name, mesh)
        scene.collection.objects.link(copy)
        copies.append(copy)
    return copies
