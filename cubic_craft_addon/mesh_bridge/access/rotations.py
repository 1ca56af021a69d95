# SPDX-License-Identifier: GPL-3.0-or-later
"""Rotation matrices to stored quaternions and back, for many vertices at once.

Offsets of shape keys are rotated and rotated back by the *stored* rotations, so that both are
inverse to each other even after the .blend was saved.
"""

import numpy as np


def quaternions_from_matrices(rotations: np.ndarray) -> np.ndarray:
    """Convert rotation matrices to unit quaternions.

    `rotations`: (n,3,3). Returns (n,4) float32 of w, x, y, z; exactly 1, 0, 0, 0 for the exact
    identity.

    All ten products of two components follow from sums of matrix entries. The row of products
    with the largest component is the quaternion times that component: no cancellation
    (Shepperd 1978).
    """
    m = np.asarray(rotations, np.float64)
    products = np.empty((len(m), 4, 4))
    xx, yy, zz = m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]
    products[:, 0, 0] = 1 + xx + yy + zz
    products[:, 1, 1] = 1 + xx - yy - zz
    products[:, 2, 2] = 1 - xx + yy - zz
    products[:, 3, 3] = 1 - xx - yy + zz
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        products[:, 0, i + 1] = products[:, i + 1, 0] = m[:, k, j] - m[:, j, k]
        products[:, i + 1, j + 1] = products[:, j + 1, i + 1] = m[:, i, j] + m[:, j, i]
    largest = np.argmax(np.diagonal(products, axis1=1, axis2=2), axis=1)
    rows = products[np.arange(len(m)), largest]
    return (rows / np.linalg.norm(rows, axis=1, keepdims=True)).astype(np.float32)


def matrices_from_quaternions(quaternions: np.ndarray) -> np.ndarray:
    """Convert quaternions, unit up to rounding, to rotation matrices.

    `quaternions`: (n,4) of w, x, y, z, none of them zero. Returns (n,3,3).
    """
    q = np.asarray(quaternions, np.float64)
    w, x, y, z = q.T
    s = 2 / np.sum(q * q, axis=1)
    matrices = np.empty((len(q), 3, 3))
    for i, row in enumerate(
        (
            (1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)),
            (s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)),
            (s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)),
        )
    ):
        matrices[:, i] = np.stack(row, axis=1)
    return matrices
