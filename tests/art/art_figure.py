# SPDX-License-Identifier: GPL-3.0-or-later
"""A person of one closed skin; painted; and with clothes on as objects of their own."""

import numpy as np
from art_objects import add, melted, paint, part_of
from art_parts import ball
from mathutils import Matrix

VOXEL = 0.0275
"""about 6000 vertices on a body that is 2 high"""
GAP = 0.008
"""of the height, between body and clothes"""
NECK = 1.53

TORSO = (((0, 0, 1.0), (0, 0, 1.12), 0.2, 0.19), ((0, 0, 1.12), (0, 0, 1.36), 0.19, 0.2))
NECK_AND_HEAD = (((0, 0, 1.45), (0, -0.01, 1.62), 0.09, 0.085),)
LIMBS = (
    # from, to, radius at each; those of the left side
    ((0.0, 0.0, 1.4), (0.24, 0.0, 1.42), 0.13, 0.095),
    ((0.24, 0.0, 1.42), (0.5, 0.0, 1.15), 0.09, 0.068),
    ((0.5, 0.0, 1.15), (0.7, -0.05, 0.92), 0.068, 0.05),
    ((0.7, -0.05, 0.92), (0.75, -0.06, 0.84), 0.06, 0.07),
    ((0.11, 0.0, 0.97), (0.16, -0.01, 0.54), 0.125, 0.09),
    ((0.16, -0.01, 0.54), (0.19, 0.02, 0.1), 0.09, 0.065),
    ((0.19, 0.02, 0.08), (0.21, -0.17, 0.06), 0.075, 0.06),
)


def limb(begin, end, radius, last_radius):
    """Return balls in a row from one place to another, so near that they melt into one limb."""
    begin, end = np.array(begin, float), np.array(end, float)
    count = 2 + int(np.linalg.norm(end - begin) / (0.25 * min(radius, last_radius)))
    return [
        ball(begin + t * (end - begin), [radius + t * (last_radius - radius)] * 3, 16, 8)
        for t in np.linspace(0, 1, count)
    ]


def both_sides(limbs):
    """Return the balls of limbs and of their mirror images."""
    return [
        part
        for begin, end, *radii in limbs
        for side in (1, -1)
        for part in limb(np.multiply(begin, (side, 1, 1)), np.multiply(end, (side, 1, 1)), *radii)
    ]


def body(voxel=VOXEL):
    """Return a smooth, closed body, 2 high, feet on the floor, that looks along -Y."""
    parts = [part for bone in (*TORSO, *NECK_AND_HEAD) for part in limb(*bone)]
    parts += [ball((0, -0.02, 1.79), (0.17, 0.19, 0.22)), ball((0, -0.2, 1.77), (0.03,) * 3, 12, 6)]
    return [melted("Body", parts + both_sides(LIMBS), voxel)]


def painted(voxel=VOXEL, border=0.0):
    """Return the body with a vertex group "Head": 1 above the neck, 0 below.

    `border`: height over which the weight falls.
    """
    (obj,) = body(voxel)
    z = part_of(obj)[0][:, 2]
    weights = np.clip((z - NECK) / border + 1, 0, 1) if border else (z > NECK).astype(float)
    paint(obj, "Head", weights)
    return [obj]


def dressed(voxel=VOXEL):
    """Return body, shirt and trousers: offset copies of the skin, open at neck, wrists and waist.

    The clothes have origins and scales of their own, as those from another file have.
    """
    (skin,) = body(voxel)
    V, faces = part_of(skin)
    normals = np.array([vertex.normal for vertex in skin.data.vertices])
    out = V + GAP * np.ptp(V[:, 2]) * normals
    x, z = np.abs(V[:, 0]), V[:, 2]
    is_neck = (np.hypot(x, V[:, 1]) < 0.13) & (z > 1.4)
    is_shirt = (z > 1.02) & (x < 0.6) & (z < NECK) & ~is_neck
    is_trousers = (z > 0.16) & (z < 0.995) & (x < 0.4)
    shirt = _cut(out, faces, is_shirt, "Shirt", (0, 0, 1.2), 0.5)
    trousers = _cut(out, faces, is_trousers, "Trousers", (0.1, 0, 0.6), 2.0)
    return [skin, shirt, trousers]


def _cut(V, faces, is_kept, name, origin, scale):
    """Add an object of the faces that are kept whole, with its origin and scale."""
    kept = [face for face in faces if all(is_kept[i] for i in face)]
    used = sorted({i for face in kept for i in face})
    renumbered = {old: new for new, old in enumerate(used)}
    kept = [tuple(renumbered[i] for i in face) for face in kept]
    obj = add(name, ((V[used] - origin) / scale, kept))
    obj.matrix_world = Matrix.Translation(origin) @ Matrix.Scale(scale, 4)
    return obj
