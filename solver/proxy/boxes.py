# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts that are already boxes, in any orientation.

A rotated box is as cubic as a shape can be; it is just not aligned. If parts keep their rotation,
it cannot turn to the cube, and the cubic term would skew it. So each such part, including an L
shape or a staircase, gets its own cube, along its own sides. So does a part with bevels or sloping
sides that is mostly a box, such as a plate or a crate, but for its limbs.
"""

from typing import Any

import numpy as np

from ..algebra import sums_by_group
from ..mesh.rest_measures import triangle_areas_and_normals

TOLERANCE = np.cos(np.radians(1.0))
"""between a side and the axes"""
SHARE = 0.999
"""of the area of a part that has to face along three axes at right angles,..."""
BEVELED = 0.25
"""...and of one that is mostly a box..."""
SQUARE = 0.5
"""...and as square as this across its first axis: 1 for a box, 0 for a cylinder"""

_STEPS = 400  # from 0 to 1, by which normals that are alike are told apart


def box_frames(V, F, part):
    """Return the frame (n,3,3) along the sides of each part, and which (n,) are wholly boxes.

    The frame is zero if the part is not even mostly a box; None instead of all if there is no such
    part. The rows of a frame are its axes.

    `V`: (n,3). `F`: (m,3) int. `part`: (n,) int.
    """
    count = int(part.max()) + 1
    area, unit = triangle_areas_and_normals(V, F)
    of_face = part[F[:, 0]]
    total = np.bincount(of_face, area, count)
    first = _most(of_face, area, unit, count)
    cosine = np.abs((unit * first[of_face]).sum(axis=1))
    second = _most(of_face, area * (cosine < np.sqrt(1.0 - TOLERANCE**2)), unit, count)
    second -= (second * first).sum(axis=1)[:, None] * first
    length = np.linalg.norm(second, axis=1)
    second /= np.where(length > 0.0, length, 1.0)[:, None]
    frames: Any = np.stack([first, second, np.cross(first, second)], axis=1)
    own = np.einsum("fij,fj->fi", frames[of_face], unit)
    boxed = np.bincount(of_face, area * (np.abs(own).max(axis=1) > TOLERANCE), count)
    is_some = (length > 0.0) & (total > 0.0)
    is_box = is_some & (boxed >= SHARE * total)
    is_mostly = is_some & (boxed >= BEVELED * total) & _square(of_face, area, own)
    frames[~(is_box | is_mostly)] = 0.0
    return frames[part] if frames.any() else None, is_box[part]


def _square(of_face, area, own):
    """Return which parts have no other sides across their first axis than along the others.

    By the mean of the cosine of four times the angle about that axis. `own`: (m,3), normals of
    triangles in the frames of their parts.
    """
    y, z = own[:, 1:].T ** 2
    across = y + z
    fourfold = (across**2 - 8.0 * y * z) / np.where(across > 0.0, across, 1.0)
    return np.bincount(of_face, area * fourfold) > SQUARE * np.bincount(of_face, area * across)


def _most(of_face, area, unit, count):
    """Return the unit normals (count,3) that most of the area of each part has; zero for none."""
    key = of_face.astype(np.int64)
    for x in np.rint(_STEPS * unit).T.astype(np.int64):
        key = (2 * _STEPS + 1) * key + x + _STEPS
    _, first, alike = np.unique(key, return_index=True, return_inverse=True)
    part, total = of_face[first], np.bincount(alike, area)
    most = np.zeros(count)
    np.maximum.at(most, part, total)
    is_most = (total == most[part]) & (total > 0.0)
    sums = sums_by_group(area[:, None] * unit, alike)[is_most]
    result = np.zeros((count, 3))
    result[part[is_most]] = sums / np.linalg.norm(sums, axis=1)[:, None]  # the last of equals
    return result
