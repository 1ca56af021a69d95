# SPDX-License-Identifier: GPL-3.0-or-later
"""A character as sculptors hand it in: a skin, and loose parts that sit in and on it."""

import bpy
import numpy as np
from art_figure import both_sides, limb
from art_objects import add, melted, part_of
from art_parts import ball, moved, revolved
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

VOXEL = 0.033
"""about 7000 vertices on a skin that is 2.1 high"""
HEAD, HEAD_RADII = (0, -0.03, 1.62), (0.42, 0.4, 0.44)
TRUNK = (((0, 0, 0.8), (0, 0, 1.05), 0.27, 0.24), ((0, 0, 1.0), (0, 0, 1.4), 0.15, 0.13))
LIMBS = (
    ((0.0, 0.0, 1.1), (0.26, 0.0, 1.1), 0.13, 0.1),
    ((0.26, 0.0, 1.1), (0.5, -0.02, 0.85), 0.1, 0.085),
    ((0.5, -0.02, 0.85), (0.68, -0.08, 0.66), 0.085, 0.09),
    ((0.13, 0.0, 0.7), (0.18, -0.01, 0.12), 0.17, 0.11),
    ((0.18, 0.0, 0.1), (0.22, -0.2, 0.08), 0.12, 0.1),
)
FINGERS = (
    ((0.72, -0.1, 0.62), (0.86, -0.24, 0.55), 0.045, 0.04),
    ((0.74, -0.08, 0.6), (0.92, -0.09, 0.5), 0.045, 0.04),
    ((0.72, -0.06, 0.6), (0.86, 0.06, 0.5), 0.045, 0.04),
    ((0.66, -0.13, 0.64), (0.7, -0.28, 0.66), 0.045, 0.04),
)
PAIRS = (
    # where, radii with the last along the skin's normal: eyes, pupils, ears, and the nails
    ((0.16, -0.5, 1.72), (0.1, 0.1, 0.1)),
    ((0.16, -0.6, 1.72), (0.035, 0.035, 0.12)),
    ((0.5, 0.0, 1.62), (0.09, 0.13, 0.05)),
    *(((x, y, z + 0.06), (0.03, 0.03, 0.012)) for (_, (x, y, z), *_) in FINGERS),
)
SINGLE = (
    # a nose and teeth
    ((0.0, -0.6, 1.6), (0.06, 0.06, 0.07)),
    *(((x, -0.5, 1.42), (0.03, 0.04, 0.03)) for x in (-0.135, -0.068, 0.0, 0.068, 0.135)),
)


def skin(voxel=VOXEL):
    """Return the skin alone: short, with a big head, fingers, and arms that hang half down."""
    trunk = [part for bone in TRUNK for part in limb(*bone)] + [ball(HEAD, HEAD_RADII)]
    return [melted("Skin", trunk + both_sides(LIMBS) + both_sides(FINGERS), voxel)]


def character(voxel=VOXEL):
    """Return one mesh of 22 parts: skin, eyes, pupils, ears, finger nails, nose, teeth, hat."""
    (obj,) = skin(voxel)
    parts = [part_of(obj)]
    bpy.data.objects.remove(obj)
    tree = BVHTree.FromPolygons(parts[0][0].tolist(), parts[0][1])
    for (x, y, z), radii in PAIRS:
        parts += [_seated(tree, (side * x, y, z), radii) for side in (1, -1)]
    parts += [_seated(tree, place, radii) for place, radii in SINGLE]
    return [add("Character", *parts, _hat())]


def _seated(tree, near, radii):
    """Return a ball halfway in the skin, at the place of the skin that is nearest."""
    place, normal, *_ = tree.find_nearest(Vector(near))
    frame = normal.to_track_quat("Z", "Y").to_matrix()
    return moved(ball(radii=radii, segments=20, rings=10), frame, place)


def _hat():
    """Return a closed hat with a brim that the upper part of the head sticks in."""
    profile = [(0, 0), (0.2, 0.0), (0.4, -0.01), (0.52, -0.03), (0.6, -0.06), (0.61, -0.03)]
    profile += [(0.5, 0.02), (0.38, 0.06), (0.33, 0.16), (0.27, 0.26), (0.2, 0.36), (0.1, 0.44)]
    tilt = Matrix.Rotation(np.radians(-12), 3, "X")
    return moved(revolved([*profile, (0, 0.46)], 36), tilt, (0, 0.05, 1.86))
