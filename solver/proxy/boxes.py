# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that are already boxes, in any orientation.

A rotated box is as cubic as a shape can be; it is just not aligned. If parts keep their rotation,
it cannot turn to the cube, and the cubic term would skew it. So each such part, including an L
shape or a staircase, gets its own cube, along its own sides.
"""

from typing import Any

import numpy as np

from ..mesh.rest_measures import triangle_areas_and_normals

TOLERANCE = np.cos(np.radians(1.0))
"""between a side and the axes"""
SHARE = 0.999
"""of the area of a part that has to face along three axes at right angles"""


def box_frames(V, F, part):
    """Return the frame (n,3,3) along the sides of each part, zero if it is not a box.

    None if there is no such part. The rows of a frame are its axes.

    `V`: (n,3). `F`: (m,3) int. `part`: (n,) int.
    """
    count = int(part.max()) + 1
    area, unit = triangle_areas_and_normals(V, F)
    of_face = part[F[:, 0]]
    total = np.bincount(of_face, area, count)
    first = _largest(of_face, area, unit, count)
    cosine = np.abs((unit * first[of_face]).sum(axis=1))
    second = _largest(of_face, area * (cosine < np.sqrt(1.0 - TOLERANCE**2)), unit, count)
    second -= (second * first).sum(axis=1)[:, None] * first
    length = np.linalg.norm(second, axis=1)
    second /= np.where(length > 0.0, length, 1.0)[:, None]
    frames: Any = np.stack([first, second, np.cross(first, second)], axis=1)
    along = np.abs(np.einsum("fij,fj->fi", frames[of_face], unit)).max(axis=1)
    boxed = np.bincount(of_face, area * (along > TOLERANCE), count)
    is_box = (boxed >= SHARE * total) & (length > 0.0) & (total > 0.0)
    if not is_box.any():
        return None
    frames[~is_box] = 0.0
    return frames[part]


def _largest(of_face, area, unit, count):
    largest = np.zeros(count)
    np.maximum.at(largest, of_face, area)
    is_largest = (area == largest[of_face]) & (area > 0.0)
    result = np.zeros((count, 3))
    result[of_face[is_largest]] = unit[is_largest]  # the last of equals
    return result
