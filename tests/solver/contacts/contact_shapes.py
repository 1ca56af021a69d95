# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes whose surfaces come near each other without crossing. All return V (n,3) and F (m,3)."""

import numpy as np
from proxy_shapes import joined, normals_of
from shapes import rotation, sheet

from tests.art import art_parts


def triangulated(part):
    """Return positions and triangles of a part of `art_parts`."""
    V, faces = part
    F = [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]
    return V, np.array(F)


def figure(step=0.05, gap=0.06, degrees=0.0):
    """Return a figure whose arms hang beside its body, a gap away."""
    reach = 0.33 + 0.11 + gap
    a = np.radians(degrees)
    hand = (reach + np.sin(a), 0.0, 1.45 - 0.85 * np.cos(a))
    bones = [
        ((0, 0, 0.75), (0, 0, 1.35), 0.3, 0.33),
        ((0, 0, 1.5), (0, 0, 1.75), 0.12, 0.1),
        ((0, 0.03, 1.95), (0, 0.03, 2.0), 0.26, 0.24),
    ]
    for side in (-1, 1):
        shoulder = (side * reach, 0.0, 1.45)
        bones += [
            ((side * 0.1, 0, 1.42), shoulder, 0.12, 0.12),
            (shoulder, (side * hand[0], hand[1], hand[2]), 0.12, 0.1),
            ((side * 0.19, 0, 0.7), (side * 0.19, 0.02, 0.0), 0.16, 0.12),
        ]

    def field(P):
        return _smooth_minimum([_bone(P, *bone) for bone in bones], 0.04)

    return surface(field, (-1.5, -0.5, -0.3), (1.5, 0.5, 2.4), step)


def dressed(step=0.06, gap=0.02):
    """Return a figure and its coat: a piece of its own, offset by a gap, that is open below."""
    V, F = figure(step, gap=0.25, degrees=12)
    middle = V[F].mean(axis=1)
    worn = F[(middle[:, 2] > 0.35) & (middle[:, 2] < 1.6)]
    used, number = np.unique(worn, return_inverse=True)
    W = V[used] + gap * 2.2 * normals_of(V, F)[used]
    return joined((V, F), (W, number.reshape(-1, 3)))


def hand(fingers=4, gap=0.003, count=5):
    """Return a hand whose fingers lie side by side, a gap of its size apart."""
    slit, width, along = 1.9 * gap, 0.2, np.linspace(0, 1, count)
    x = np.concatenate([k * (width + slit) + width * along for k in range(fingers)])
    y, z = np.linspace(0, 1.9, 9 * count), np.linspace(-0.12, 0.12, count)
    is_filled = np.ones((len(x) - 1, len(y) - 1, len(z) - 1), bool)
    slits = np.arange(1, fingers) * count - 1
    is_filled[slits, np.searchsorted(y, 0.75) :] = False
    V, F = triangulated(art_parts.blocks(x, y, z, is_filled))
    V[:, 2] += 0.25 * np.sin(1.2 * V[:, 1]) * (1 - 0.3 * V[:, 0])
    return V @ rotation(20, 10, 12).T, F


def lips(gap=0.004, count=24):
    """Return a head with a mouth: a slit that goes in by a third."""
    grid = np.linspace(-1, 1, count)
    z = np.sort(np.append(grid + 0.013, [-0.2, -0.2 + 2 * gap]))
    is_filled = np.ones((count - 1, count - 1, len(z) - 1), bool)
    mouth = np.searchsorted(z, -0.2)
    is_wide = np.abs(0.5 * (grid[1:] + grid[:-1])) < 0.6
    is_filled[np.ix_(is_wide, grid[1:] < -0.4, [mouth])] = False
    V, F = triangulated(art_parts.blocks(grid, grid, z, is_filled))
    return round_of(V) @ rotation(15, 5, 10).T, F


def spring(turns=6, sides=10, per_turn=36, gap=0.06):
    """Return a coil spring whose turns are a gap of its height apart."""
    radius = 0.1
    t = np.linspace(0, 2 * np.pi * turns, turns * per_turn + 1)
    rise = (2 * radius + 0.5 * gap) / (2 * np.pi)
    out = np.stack([np.cos(t), np.sin(t), 0 * t], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    a = np.linspace(0, 2 * np.pi, sides, endpoint=False)[:, None, None]
    rings = (0.5 + radius * np.cos(a)) * out + (rise * t[:, None] + radius * np.sin(a)) * up
    V = rings.transpose(1, 0, 2).reshape(-1, 3)
    i = np.arange(len(t) * sides).reshape(len(t), sides)
    j = np.roll(i, -1, axis=1)
    quads = [i[:-1], i[1:], j[1:], j[:-1]]
    p, q, r, s = (x.ravel() for x in quads)
    caps = [(i[0, 0], i[0, k], i[0, k + 1]) for k in range(1, sides - 1)]
    caps += [(i[-1, 0], i[-1, k + 1], i[-1, k]) for k in range(1, sides - 1)]
    return V, np.concatenate(
        [np.stack([p, q, r], 1), np.stack([p, r, s], 1), np.array(caps)[:, ::-1]]
    )


def layers(count=4, gap=0.01, side=24):
    """Return wavy sheets that lie over each other, a gap of their size apart."""
    sheets = []
    for k in range(count):
        V, F = sheet(side)
        x, y, _ = V.T
        z = 0.15 * np.sin(7 * x + 0.3) * np.cos(5 * y) + gap * k
        sheets.append((np.column_stack([x + 0.003 * k, y, z]), F))
    return joined(*sheets)


def round_of(V):
    """Return points of the cube from -1 to 1, moved most of the way onto a ball."""
    radius = np.linalg.norm(V, axis=1, keepdims=True)
    size = np.abs(V).max(axis=1, keepdims=True)
    return V * (0.3 + 0.7 * size / np.maximum(radius, 1e-9))


def surface(field, low, high, step, rounds=3):
    """Return where a field is zero, as a mesh of quads with a vertex in each cell of a grid.

    The vertices are then averaged and brought back to the surface a few times.
    """
    axes = [np.arange(a, b + step, step) for a, b in zip(low, high, strict=True)]
    P = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    is_inside = field(P) < 0.0
    shape = np.array(is_inside.shape)
    quads = []
    for axis in range(3):
        b, c = np.eye(3, dtype=int)[(axis + 1) % 3], np.eye(3, dtype=int)[(axis + 2) % 3]
        change = np.diff(is_inside.astype(int), axis=axis)
        for sign in (1, -1):
            edge = np.argwhere(change == sign)
            ring = np.stack([edge - b - c, edge - c, edge, edge - b], axis=1)
            quads.append(ring[:, ::-1] if sign == 1 else ring)
    cells = np.ravel_multi_index(np.moveaxis(np.concatenate(quads), 2, 0), shape)
    used, faces = np.unique(cells, return_inverse=True)
    faces = faces.reshape(-1, 4)
    V = np.asarray(low) + step * (np.stack(np.unravel_index(used, shape), axis=1) + 0.5)
    F = np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
    for _ in range(rounds):
        V = _on_surface(field, V, step)
        sums, count = np.zeros_like(V), np.zeros(len(V))
        for k in range(4):
            np.add.at(sums, faces[:, k], V[faces[:, k - 1]])
            np.add.at(count, faces[:, k], 1)
        V = 0.5 * V + 0.5 * sums / count[:, None]
    return _on_surface(field, V, step), F


def _on_surface(field, V, step):
    h = 1e-4
    for _ in range(2):
        slope = [(field(V + h * e) - field(V - h * e)) / (2 * h) for e in np.eye(3)]
        slope = np.stack(slope, axis=1)
        way = field(V)[:, None] * slope / np.maximum((slope**2).sum(1), 0.1)[:, None]
        V = V - np.clip(way, -step, step)
    return V


def _bone(P, begin, end, radius, last_radius):
    """Return the distance of points to a limb that tapers."""
    begin, axis = np.asarray(begin, float), np.subtract(end, begin)
    t = np.clip((P - begin) @ axis / (axis @ axis), 0, 1)
    distance = np.linalg.norm(P - begin - t[..., None] * axis, axis=-1)
    return distance - radius - t * (last_radius - radius)


def _smooth_minimum(values, width):
    values = np.stack(values)
    least = values.min(axis=0)
    return least - width * np.log(np.exp(-(values - least) / width).sum(axis=0))
