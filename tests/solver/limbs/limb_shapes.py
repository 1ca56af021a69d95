# SPDX-License-Identifier: GPL-3.0-or-later
"""Tubes: bars, springs and tails, and what covers them."""

import numpy as np


def tube(path, radius, sides=32, is_capped=True):
    """Return a tube around a path (k,3), with a lid of triangles at both ends."""
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    normal = np.cross(along[0], [0.3, 0.5, 0.8])
    rings = []
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)[:, None]
    for place, way in zip(path, along, strict=True):
        normal = normal - (normal @ way) * way
        normal /= np.linalg.norm(normal)
        other = np.cross(way, normal)
        rings.append(place + radius * (np.cos(angle) * normal + np.sin(angle) * other))
    if is_capped:
        lids = [
            ring + (1 - share) * (place - ring)
            for ring, place in ((rings[0], path[0]), (rings[-1], path[-1]))
            for share in (0.66, 0.33)
        ]
        rings = [lids[1], lids[0], *rings, lids[2], lids[3]]
    V = np.concatenate(rings)
    i = np.arange(len(V)).reshape(-1, sides)
    j = np.roll(i, -1, axis=1)
    a, b, c, d = i[:-1].ravel(), j[:-1].ravel(), j[1:].ravel(), i[1:].ravel()
    faces = [np.stack([a, b, c], 1), np.stack([a, c, d], 1)]
    if is_capped:
        n = len(V)
        V = np.concatenate([V, path[[0, -1]]])
        faces += [
            np.stack([j[0], i[0], np.full(sides, n)], 1),
            np.stack([i[-1], j[-1], np.full(sides, n + 1)], 1),
        ]
    return V, np.concatenate(faces)


def bar(turn, length=3.0, radius=0.2):
    """Return a bar along the rotated Z axis."""
    z = np.linspace(-length / 2, length / 2, 60)
    V, F = tube(np.outer(z, [0.0, 0.0, 1.0]), radius)
    return V @ turn.T, F


def spring(turns=6, radius=0.12):
    """Return a coil spring of radius 1 that rises by 0.45 in each turn."""
    t = np.linspace(0, turns * 2 * np.pi, 60 * turns)
    return tube(np.stack([np.cos(t), np.sin(t), 0.45 * t / (2 * np.pi)], axis=1), radius, 16)
