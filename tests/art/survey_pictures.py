# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of a case as it is and as it becomes, in the studio of the command line."""

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

RESOLUTION = (900, 330)
SAMPLES = 24
FINISHES = ("clay", "grey", "teal")
COLUMNS = 2
"""of a sheet"""


def render(objects, surfaces, path: Path):
    """Write a picture of surfaces of the objects, which are the values of their labels."""
    scene = scene_for_gallery()
    size = extent_of(next(iter(surfaces.values())).V)
    groups = [
        Group(
            label,
            _copies(objects, surface, scene),
            [Matrix()] * len(objects),
            surface.V,
            size,
            finish,
        )
        for (label, surface), finish in zip(surfaces.items(), FINISHES, strict=True)
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


def write_sheet(paths, path: Path):
    """Write pictures of one size as one, row by row."""
    width, height = RESOLUTION
    rows = -(-len(paths) // COLUMNS)
    sheet = np.ones((rows, height, COLUMNS, width, 4), np.float32)  # the lowest row first
    for number, single in enumerate(paths):
        image = bpy.data.images.load(str(single))
        pixels = np.empty(4 * width * height, np.float32)
        image.pixels.foreach_get(pixels)
        row, column = divmod(number, COLUMNS)
        sheet[rows - 1 - row, :, column] = pixels.reshape(height, width, 4)
        bpy.data.images.remove(image)
    image = bpy.data.images.new("Sheet", COLUMNS * width, rows * height)
    image.pixels.foreach_set(sheet.ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()


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
