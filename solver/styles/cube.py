# SPDX-License-Identifier: GPL-3.0-or-later
"""The cube: the cost of a normal, its symmetries, and the edges to draw."""

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
"""(12,2,3) ends of the edges of a cube with half size 1"""


def cost(x):
    """Return the cost |x|_1 of normals x (...,3) in the frame of the cube, least on its axes."""
    return np.abs(x).sum(axis=-1)


def proximal(x, threshold):
    """Return the z (n,3) that minimises ``threshold cost(z) + |z - x|^2 / 2``: soft thresholding.

    Parameters
    ----------
    x : (n,3) numpy array
    threshold : (n,1) numpy array
    """
    return np.sign(x) * np.maximum(np.abs(x) - threshold, 0.0)


def nearest_to_identity(Q):
    """Return the rotation nearest to the identity that is equivalent to Q for a cube.

    Parameters
    ----------
    Q : (3,3) numpy array

    Returns
    -------
    (3,3) numpy array
        One of the 24 rotations that map the cube to the same orientation as Q does.

    See Also
    --------
    auto_orient : Returns such a rotation.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import nearest_to_identity
    >>> quarter_turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    >>> np.allclose(nearest_to_identity(quarter_turn), np.eye(3))
    True
    """
    same = _symmetries() @ Q
    return same[np.argmax(np.trace(same, axis1=1, axis2=2))]


def proper(matrix):
    """Return the rotation (3,3) that is equivalent for a cube, which equals its mirror image."""
    return matrix if np.linalg.det(matrix) > 0.0 else -matrix


@cache
def _symmetries():
    """Return the rotations (24,3,3) that map a cube to itself."""
    from scipy.spatial.transform import Rotation  # here, because drawing the cube does not need it

    return Rotation.create_group("O").as_matrix()
