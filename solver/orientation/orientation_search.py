# SPDX-License-Identifier: GPL-3.0-or-later
"""What the searches for the best orientation share: fewer normals, and evenly spread rotations."""

import numpy as np


def binned(normals, areas, bins):
    """Return mean directions (k,3) of the cells of the sphere and their areas (k,).

    `normals`: (n,3), unit normals; zero ones are left out. `areas`: (n,), those with area zero are
    left out. `bins`: int, cells per unit length.
    """
    is_there = (areas > 0.0) & (np.abs(normals).max(axis=1) > 0.0)
    n, a = normals[is_there], areas[is_there]
    _, cell = np.unique(np.round(bins * n).astype(np.int64), axis=0, return_inverse=True)
    cell = cell.ravel()
    sums = np.stack([np.bincount(cell, a * n[:, c]) for c in range(3)], axis=1)
    return sums / np.linalg.norm(sums, axis=1, keepdims=True), np.bincount(cell, a)


def super_fibonacci(count):
    """Return evenly spread unit quaternions (count,4), scalar last.

    They are super-Fibonacci spirals (Alexa, CVPR 2022).
    """
    s = np.arange(count) + 0.5
    a, b = 2 * np.pi * s / np.sqrt(2), 2 * np.pi * s / 1.533751168755204288
    r, t = np.sqrt(s / count), np.sqrt(1 - s / count)
    return np.stack([r * np.sin(a), r * np.cos(a), t * np.sin(b), t * np.cos(b)], axis=1)
