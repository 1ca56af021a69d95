# SPDX-License-Identifier: GPL-3.0-or-later
"""The cube: what a normal costs, what looks the same to it, and what to draw of it."""

import itertools
from functools import cache

import numpy as np

EDGES = np.array(
    [
        (a, b)
        for a, b in itertools.combinations(itertools.product((-1.0, 1.0), repeat=3), 2)
        if sum(x != y for x, y in zip(a, b, strict=True)) == 1
    ]
)
"""(12,2,3) the ends of its edges, for a cube of half size 1"""


def cost(x):
    """Return what normals x (...,3) in the frame of the cube cost: |x|_1, least on its axes."""
    return np.abs(x).sum(axis=-1)


def proximal(x, threshold):
    """Return the z (n,3) of least ``threshold cost(z) + |z - x|^2 / 2``: soft thresholding.

    Parameters
    ----------
    x : (n,3) float array
    threshold : (n,1) float array
    """
    return np.sign(x) * np.maximum(np.abs(x) - threshold, 0.0)


def nearest_to_identity(Q):
    """Return the rotation nearest to the identity that is the same as Q (3,3) for a cube."""
    same = _symmetries() @ Q
    return same[np.argmax(np.trace(same, axis1=1, axis2=2))]


def proper(matrix):
    """Return the rotation (3,3) that is the same for a cube, which looks alike in a mirror."""
    return matrix if np.linalg.det(matrix) > 0.0 else -matrix


@cache
def _symmetries():
    """Return the rotations (24,3,3) after which a cube looks as before."""
    from scipy.spatial.transform import Rotation  # here, as drawing the cube needs none of it

    return Rotation.create_group("O").as_matrix()
