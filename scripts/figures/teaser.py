# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 1: several meshes in grey, and before them in green what becomes of them."""

import math

from headless.gallery import ELEVATION, UP, Gallery, outline, scene_for_gallery, stand
from headless.studio import furnish
from mathutils import Vector

from .figure_meshes import FigureMeshes
from .picture import NOMINAL_WIDTH, Picture

__all__ = ("compose",)

CAST = {"owl": 0.4, "bunny": 0.4, "armadillo": 0.3, "spot": 0.4, "horse": 0.15}
OWN_CAST = {"bear": 0.4, "duck": 0.4, "monkey": 0.4, "letter": 0.4}
"""name: cubeness"""
HEIGHT = 860
"""pixels"""
GAP = 0.35
"""between neighbours, in the units of the gallery"""
ROWS_APART = 0.25
"""in the picture, between the top of the front row and the bottom of the back row"""


def compose(meshes: FigureMeshes) -> Picture:
    """Stand the originals in a row, and the cubic versions in one before it."""
    models = meshes.there(list(CAST), instead=list(OWN_CAST))
    cubeness = CAST | OWN_CAST
    shapes = [meshes.cubified(model, cubeness[model.name]) for model in models]
    scene = scene_for_gallery()
    gallery = Gallery(scene, [], Vector(), 0.0, 0.0, [])
    pairs = []
    for model, shape in zip(models, shapes, strict=True):
        grey = meshes.group(model, model.original, f"{model.name}, original", "grey")
        pairs.append((grey, meshes.group(model, shape, f"{model.name}, cubic", "green")))
    outlines = [[outline(group, turns=False) for group in pair] for pair in pairs]
    lift = max(front[3] for _, front in outlines) + ROWS_APART
    lift -= min(back[2] for back, _ in outlines)
    x = 0.0
    for pair, (back, front) in zip(pairs, outlines, strict=True):
        left, right = min(back[0], front[0]), max(back[1], front[1])
        for group, y in zip(pair, (lift / math.sin(ELEVATION), 0.0), strict=True):
            for copy in group.copies:
                scene.collection.objects.link(copy)
            gallery.turntables.append(stand(group, Vector((x - left, y, 0.0)), scene))
            gallery.finishes.append(group.finish)
        x += right - left + GAP
    gallery.width = x
    bottom = min(front[2] for _, front in outlines)
    top = lift + max(back[3] for back, _ in outlines)
    gallery.height = top - bottom + GAP
    gallery.centre = Vector(((x - GAP) / 2, 0.0, 0.0)) + UP * ((bottom + top) / 2)
    furnish(gallery, NOMINAL_WIDTH / HEIGHT)
    return Picture(gallery, HEIGHT)
