# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 1: several meshes in gray, and before them in green what becomes of them."""

import math

import bpy
from mathutils import Vector

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import (
    ELEVATION,
    UP,
    Gallery,
    Group,
    outline,
    stand,
)

from .figure_meshes import FigureMeshes

CAST = {"owl": 0.4, "bunny": 0.4, "armadillo": 0.4, "spot": 0.4, "horse": 0.4}
OWN_CAST = {"bear": 0.4, "monkey": 0.4, "fox": 0.4}
"""name: cubeness"""
GAP = 0.35
"""between neighbors, in the units of the gallery"""
ROWS_APART = 0.25
"""in the picture, between the top of the front row and the bottom of the back row"""


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return each original, and after it its cubic version."""
    groups = []
    for model in meshes.there(list(CAST), instead=list(OWN_CAST)):
        shape = meshes.cubified(model, (CAST | OWN_CAST)[model.name])
        groups.append(meshes.group(model, model.original, f"{model.name}, original", "grey"))
        groups.append(meshes.group(model, shape, f"{model.name}, cubic", "green"))
    return groups


def in_two_rows(
    groups: list[Group], scene: bpy.types.Scene, _resolution: tuple[int, int]
) -> Gallery:
    """Stand the originals in a row, and the cubic versions in one before it."""
    outlines = [outline(group, turns=False) for group in groups]  # left, right, bottom, top
    backs, fronts = outlines[::2], outlines[1::2]
    lift = max(front[3] for front in fronts) + ROWS_APART - min(back[2] for back in backs)
    x, turntables = 0.0, []
    for number, (back, front) in enumerate(zip(backs, fronts, strict=True)):
        left, right = min(back[0], front[0]), max(back[1], front[1])
        for group, y in zip(groups[2 * number :], (lift / math.sin(ELEVATION), 0.0), strict=False):
            turntables.append(stand(group, Vector((x - left, y, 0.0)), scene))
        x += right - left + GAP
    bottom, top = min(front[2] for front in fronts), lift + max(back[3] for back in backs)
    center = Vector(((x - GAP) / 2, 0.0, 0.0)) + UP * ((bottom + top) / 2)
    finishes = [group.finish for group in groups]
    return Gallery(scene, turntables, center, x, top - bottom + GAP, finishes)
