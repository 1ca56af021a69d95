# SPDX-License-Identifier: GPL-3.0-or-later
"""Beams and posts of what is mostly a box, as the sides of a window in a wall.

The midpoints of a few large triangles say only roughly which way a beam lies; its sides say it to
the degree. Where they lie along the box, it has the frame of that.
"""

from dataclasses import replace

import numpy as np

ALONG = np.cos(np.radians(8.0))
"""of the angle between a side and the frame of the box"""
SHARE = 0.6
"""of the area of a piece that lies so"""


def along_boxes(limbs, frames, F, areas, normals):
    """Return the Limbs in which the pieces that lie along boxes have the frame of the object.

    `frames`: (n,3,3) or None, as of `box_frames`. `areas`, `normals`: (m,) and (m,3), of F (m,3).
    """
    if frames is None or not len(limbs):
        return limbs
    along = np.einsum("mij,mj->mi", frames[F[:, 0]], normals)
    is_along = np.abs(along).max(axis=1) > ALONG
    at_corners = (np.repeat(x, 3) for x in (areas, areas * is_along))
    total, boxed = (limbs.shares.T @ np.bincount(F.ravel(), x, len(frames)) for x in at_corners)
    directions = np.where((boxed >= SHARE * total)[:, None], 0.0, limbs.directions)
    return replace(limbs, directions=directions)
