# SPDX-License-Identifier: GPL-3.0-or-later
"""Simple closed and open surfaces as arrays: what the meshes of artists are put together from.

A part is a pair: V (n,3) float64 positions, and a list of faces, tuples of vertex numbers that go
counterclockwise as seen from outside.
"""

from itertools import pairwise

import numpy as np


def revolved(profile, segments):
    """Return the surface that a profile sweeps about the Z axis.

    `profile`: (k,2) radius and height; from the bottom up along the outside. An end on the axis
    becomes a pole, any other end a boundary. `segments`: int.
    """
    profile = np.asarray(profile, float)
    angle = np.linspace(0, 2 * np.pi, segments, endpoint=False)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points, rows = [], []
    for radius, height in profile:
        ring = circle if radius > 0 else np.zeros((1, 2))
        first = sum(map(len, points))
        rows.append((first + np.arange(segments) % len(ring)).tolist())
        points.append(np.column_stack([radius * ring, np.full(len(ring), height)]))
    return np.concatenate(points), _between(rows, is_closed=True)


def ball(centre=(0, 0, 0), radii=(1, 1, 1), segments=24, rings=12):
    """Return an ellipsoid with poles on the Z axis, of segments * (rings - 1) + 2 vertices."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, rings + 1)
    profile = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    profile[[0, -1], 0] = 0
    V, faces = revolved(profile, segments)
    return V * radii + np.asarray(centre, float), faces


def tube(path, radii, sides=16, is_capped=True):
    """Return a tube about a path (k,3) in the plane of Y = const, with a radius at each point."""
    path = np.asarray(path, float)
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.cross(along, [0, 1, 0])
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)[:, None]
    rings = [
        point + radius * (np.cos(angle) * a + np.sin(angle) * [0, 1, 0])
        for point, radius, a in zip(path, radii, across, strict=True)
    ]
    rows = np.arange(len(path) * sides).reshape(len(path), sides).tolist()
    faces = [face[::-1] for face in _between(rows, is_closed=True)]
    if is_capped:
        faces += [tuple(rows[0]), tuple(rows[-1][::-1])]
    return np.concatenate(rings), faces


def sheet(place, columns, rows):
    """Return an open surface: `place` takes x, y (rows, columns) in 0..1 to three coordinates."""
    y, x = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    V = np.stack([np.broadcast_to(c, x.shape) for c in place(x, y)], axis=-1).reshape(-1, 3)
    numbers = np.arange(rows * columns).reshape(rows, columns).tolist()
    return V.astype(float), _between(numbers, is_closed=False)


def box(size, centre=(0, 0, 0), top=(1, 1)):
    """Return a box of 8 vertices; `top` scales its upper side in X and Y."""
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float) / 2
    V = np.zeros((8, 3))
    V[:4, :2], V[4:, :2] = corners, corners * top
    V[:4, 2], V[4:, 2] = -0.5, 0.5
    sides = [(i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4) for i in range(4)]
    return V * size + np.asarray(centre, float), [(3, 2, 1, 0), (4, 5, 6, 7), *sides]


def blocks(x, y, z, is_filled):
    """Return the surface of the filled cells of a grid.

    `x`, `y`, `z`: (a+1,), (b+1,), (c+1,) positions of the grid's planes. `is_filled`: (a,b,c) bool.
    """
    shape = np.array([len(x), len(y), len(z)])
    padded = np.pad(is_filled, 1)
    quads = []
    for axis in range(3):
        b, c = np.eye(3, dtype=int)[(axis + 1) % 3], np.eye(3, dtype=int)[(axis + 2) % 3]
        step = np.diff(padded.astype(int), axis=axis)
        for sign in (1, -1):
            cell = np.argwhere(step == sign)
            corner = cell - 1
            corner[:, axis] += 1  # the plane between this cell and the next
            ring = np.stack([corner, corner + b, corner + b + c, corner + c], axis=1)
            quads.append(ring[:, ::-1] if sign == 1 else ring)
    numbers = np.ravel_multi_index(np.moveaxis(np.concatenate(quads), 2, 0), shape)
    used, faces = np.unique(numbers, return_inverse=True)
    i, j, k = np.unravel_index(used, shape)
    V = np.stack([np.asarray(x)[i], np.asarray(y)[j], np.asarray(z)[k]], axis=1)
    return V.astype(float), [tuple(face) for face in faces.reshape(-1, 4).tolist()]


def moved(part, matrix=None, offset=(0, 0, 0)):
    """Return the part turned by a matrix (3,3), then moved."""
    V, faces = part
    matrix = np.eye(3) if matrix is None else np.asarray(matrix)
    return V @ matrix.T + np.asarray(offset, float), faces


def united(parts):
    """Return all parts as one, and the number of the part of each face, as a list."""
    first, faces, numbers = 0, [], []
    for number, (V, own) in enumerate(parts):
        faces += [tuple(first + i for i in face) for face in own]
        numbers += [number] * len(own)
        first += len(V)
    return (np.concatenate([V for V, _ in parts]), faces), numbers


def _between(rows, is_closed):
    """Return the faces between rows of vertex numbers; triangles where a row is one pole."""
    faces = []
    for low, high in pairwise(rows):
        for i in range(len(low) if is_closed else len(low) - 1):
            j = (i + 1) % len(low)
            face = dict.fromkeys([low[i], low[j], high[j], high[i]])
            faces.append(tuple(face))
    return faces
