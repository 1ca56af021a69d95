# SPDX-License-Identifier: GPL-3.0-or-later
"""From which of its four sides a sculpture shows most."""

import math

import bpy
import numpy as np
from mathutils import Matrix, Vector, geometry
from mathutils.bvhtree import BVHTree

from ... import mesh_bridge

MOST = 400
"""vertices that are looked for"""
BETTER = 1.1
"""times as much must be seen from another side to turn to it"""


def best_yaw(
    objects: list[bpy.types.Object], places: list[Matrix], yaw: float, elevation: float
) -> float:
    """Return the turn about Z, of this one and those a quarter further, that shows most.

    That is how much of the picture the objects cover, times the share of their vertices that is
    seen: a face has more of them than the back of a head.

    `places`: where each object is. `yaw`, `elevation`: radians, of the objects toward a camera that
    looks along Y, and of that.
    """
    points, triangles, count = [], [], 0
    for obj, place in zip(objects, places, strict=True):
        own, faces = mesh_bridge.read_evaluated(obj)
        matrix = np.array(place)
        points.append(own @ matrix[:3, :3].T + matrix[:3, 3])
        triangles.append(faces + count)
        count += len(own)
    V, F = np.concatenate(points).astype(np.float64), np.concatenate(triangles)
    if not len(F):
        return yaw
    V -= V.mean(axis=0)
    tree = BVHTree.FromPolygons(V.tolist(), F.tolist())
    used = np.unique(F)
    samples = V[used[:: -(-len(used) // MOST)]]
    yaws = [yaw + quarter * math.pi / 2 for quarter in range(4)]
    shown = [_shown(samples, tree, turn, elevation) for turn in yaws]
    best = int(np.argmax(shown))
    return yaws[best] if shown[best] > BETTER * shown[0] else yaw


def _shown(samples: np.ndarray, tree: BVHTree, yaw: float, elevation: float) -> float:
    turn = Matrix.Rotation(yaw, 3, "Z")
    to_camera = turn.inverted() @ Vector((0.0, -math.cos(elevation), math.sin(elevation)))
    turned = samples @ np.array(turn).T
    picture = np.stack(
        [turned[:, 0], turned[:, 1] * math.sin(elevation) + turned[:, 2] * math.cos(elevation)], 1
    )
    outline = picture[geometry.convex_hull_2d(picture.tolist())]
    x, y = outline.T
    area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    away = to_camera * (1e-4 * float(np.ptp(samples, axis=0).max()))
    seen = [tree.ray_cast(Vector(p) + away, to_camera)[0] is None for p in samples.tolist()]
    return area * float(np.mean(seen))
