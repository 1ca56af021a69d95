# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that artists have and the paper does not."""

from itertools import pairwise

import numpy as np
import shapes

_CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def box(size=(1, 1, 1), turn=0):
    """Return a box of 8 vertices; `turn` chooses the diagonal of each side by its bits."""
    faces = []
    for k, (a, b, c, d) in enumerate(_SIDES):
        faces += [(a, b, c), (a, c, d)] if turn >> k & 1 else [(a, b, d), (b, c, d)]
    return _CORNERS * size, np.array(faces)


def uv_sphere(segments=16, rings=8):
    """Return a sphere as modellers begin with."""
    theta = np.pi * np.arange(1, rings) / rings
    phi = 2 * np.pi * np.arange(segments) / segments
    ring = np.stack(
        [
            np.outer(np.sin(theta), np.cos(phi)),
            np.outer(np.sin(theta), np.sin(phi)),
            np.outer(np.cos(theta), np.ones(segments)),
        ],
        axis=-1,
    ).reshape(-1, 3)
    V = np.concatenate([[[0, 0, 1.0]], ring, [[0, 0, -1.0]]])
    i = np.arange(segments)
    j = (i + 1) % segments
    faces = [np.stack([0 * i, 1 + i, 1 + j], 1)]
    for k in range(rings - 2):
        a, b = 1 + k * segments, 1 + (k + 1) * segments
        faces += [np.stack([a + i, b + i, b + j], 1), np.stack([a + i, b + j, a + j], 1)]
    last = 1 + (rings - 2) * segments
    faces.append(np.stack([last + i, 0 * i + len(V) - 1, last + j], 1))
    return V, np.concatenate(faces)


def revolved(outline, around, step=np.inf):
    """Return an outline (radius, height) turned around the vertical axis, open at both ends.

    Its lines are split into steps of about this length.
    """
    rows = [np.array(outline[:1], float)]
    for a, b in pairwise(np.asarray(outline, float)):
        count = max(round(np.linalg.norm(b - a) / step), 1)
        rows.append(a + (b - a) * np.arange(1, count + 1)[:, None] / count)
    radius, height = np.concatenate(rows).T[..., None]
    angle = np.arange(around) * 2.0 * np.pi / around
    places = [radius * np.cos(angle), radius * np.sin(angle), height + 0.0 * angle]
    V = np.stack(places, axis=-1).reshape(-1, 3)
    ring, k = np.divmod(np.arange(len(V) - around), around)
    a, b = ring * around + k, ring * around + (k + 1) % around
    first, second = (a, b, b + around), (a, b + around, a + around)
    return V, np.concatenate([np.stack(first, axis=1), np.stack(second, axis=1)])


def torus(count=48, around=12, thickness=0.25):
    """Return a torus of radius 1 about the vertical axis, in quads (m,4)."""
    i, j = (x.ravel() for x in np.indices((count, around)))
    a, b = 2.0 * np.pi * i / count, 2.0 * np.pi * j / around
    far = 1.0 + thickness * np.cos(b)
    V = np.stack([far * np.cos(a), far * np.sin(a), thickness * np.sin(b)], axis=1)
    ahead, up = (i + 1) % count * around, (j + 1) % around
    return V, np.stack([i * around + j, ahead + j, ahead + up, i * around + up], axis=1)


def house():
    """Return a house of 10 vertices whose roof leans to two sides, in polygons."""
    V = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.5, 1.5) for z in (0.0, 1.5)])
    V = np.concatenate([V, [[0.0, -1.5, 2.5], [0.0, 1.5, 2.5]]])
    walls = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 2, 6, 4], [0, 4, 5, 8, 1], [2, 3, 9, 7, 6]]
    return V, [*walls, [1, 8, 9, 3], [5, 7, 9, 8]]


def joined(*meshes):
    """Return several meshes as one."""
    starts = np.cumsum([0, *(len(V) for V, _ in meshes)])
    F = [F + start for (_, F), start in zip(meshes, starts, strict=False)]
    return np.concatenate([V for V, _ in meshes]), np.concatenate(F)


def split(V, F):
    """Return the mesh with vertices of its own for each face, as a flat shaded .glb has."""
    return V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3)


def cut(V, F):
    """Return the mesh with the vertices of one half doubled, as a seam of UVs does."""
    is_far = V[F].mean(axis=1)[:, 0] > V[:, 0].mean()
    halves = []
    for half in (F[~is_far], F[is_far]):
        used, number = np.unique(half, return_inverse=True)
        halves.append((V[used], number.reshape(-1, 3)))
    return joined(*halves)


def eye_in_head():
    """Return a blob with a ball that is sunk into it by half."""
    V, F = shapes.blob(4)
    W, G = shapes.sphere(2)
    top = V[V[:, 2].argmax()]
    return joined((V, F), (0.2 * W + top, G))


def blob_with_shirt(gap=0.01):
    """Return a closed blob, and an open sheet around its waist."""
    V, F = shapes.blob(4)
    low, high = np.quantile(V[:, 2], [0.3, 0.7])
    middle = V[F].mean(axis=1)[:, 2]
    worn = F[(middle > low) & (middle < high)]
    used, number = np.unique(worn, return_inverse=True)
    W = V[used] + gap * np.ptp(V, axis=0).max() * normals_of(V, F)[used]
    return joined((V, F), (W, number.reshape(-1, 3)))


def normals_of(V, F):
    """Return unit vertex normals."""
    face = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    sums = np.zeros_like(V)
    for k in range(3):
        np.add.at(sums, F[:, k], face)
    return sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-12)
