# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed meshes, some broken, with places near each other that do not belong together."""

from itertools import pairwise

import numpy as np
from art_objects import add
from art_parts import ball, blocks, moved, revolved
from mathutils import Matrix

FINGERS = 4
WIDTH = 0.2
"""of a finger; the hand is about 1.9 long"""
SLIT = 0.003 * 1.9
"""between two fingers that lie side by side: 0.3 % of the size"""


def hand(is_inverted=False, degrees=12):
    """Return a hand, one closed skin, whose fingers lie side by side.

    Each finger has a vertex group of its own, "Finger 0" to "Finger 3", and the palm one, "Palm".

    `is_inverted`: the normals point inside. `degrees`: turn of the hand in its plane.
    """
    across = np.linspace(0, 1, 7)
    x = np.concatenate([k * (WIDTH + SLIT) + WIDTH * across for k in range(FINGERS)])
    y, z = np.linspace(0, 1.9, 48), np.linspace(-0.5, 0.5, 7)
    is_filled = np.ones((len(x) - 1, len(y) - 1, len(z) - 1), bool)
    knuckles = np.searchsorted(y, 0.75)
    slits = np.arange(1, FINGERS) * len(across) - 1
    is_filled[slits, knuckles:] = False
    V, faces = blocks(x, y, z, is_filled)
    part = _rounded(V), [face[::-1] for face in faces] if is_inverted else faces
    turned = moved(part, Matrix.Rotation(np.radians(degrees), 3, (0.3, 0.2, 1)))
    obj = add("Hand", turned)
    finger = np.minimum(V[:, 0] // (WIDTH + SLIT), FINGERS - 1)
    for number in range(FINGERS):
        tip = np.flatnonzero((finger == number) & (V[:, 1] > y[knuckles]))
        obj.vertex_groups.new(name=f"Finger {number}").add(tip.tolist(), 1.0, "REPLACE")
    palm = np.flatnonzero(V[:, 1] <= y[knuckles])
    obj.vertex_groups.new(name="Palm").add(palm.tolist(), 1.0, "REPLACE")
    return [obj]


def spring(turns=6, radius=1.0, pitch=0.5, wire=0.1, sides=12, steps=40):
    """Return a coil spring of one closed skin, its axis along Z, free at both ends."""
    share = np.linspace(0, turns, turns * steps + 1)
    angle = 2 * np.pi * share
    out = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)
    path = radius * out + pitch * share[:, None] * [0, 0, 1]
    along = np.gradient(path, axis=0)
    up = np.cross(along / np.linalg.norm(along, axis=1, keepdims=True), -out)
    around = np.linspace(0, 2 * np.pi, sides, endpoint=False)[:, None, None]
    rings = path + wire * (np.cos(around) * out + np.sin(around) * up)
    numbers = np.arange(sides * len(path)).reshape(sides, len(path)).T
    faces = [
        (high[k], high[(k + 1) % sides], low[(k + 1) % sides], low[k])
        for low, high in pairwise(numbers.tolist())
        for k in range(sides)
    ]
    faces += [tuple(numbers[0].tolist()), tuple(numbers[-1, ::-1].tolist())]
    return [add("Spring", (rings.reshape(-1, 3), faces))]


def cup(segments=48):
    """Return a cup whose wall, 2 % of the size thick, has an inside and an outside."""
    outer = [(0, 0), (0.3, 0), (0.55, 0.03), (0.6, 0.1), (0.62, 0.2), (0.62, 1.2)]
    inner = [(r - 0.025 if r else 0, max(z, 0.03)) for r, z in outer[::-1]]
    inner = [(r, z) for r, z in inner if r == 0 or z > 0.05 or r < 0.5]
    return [add("Cup", revolved(_filled(outer + inner), segments))]


def pinched_torus(segments=48, sides=24):
    """Return a torus whose hole is closed to a gap of 0.2 % of the size."""
    angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    profile = np.stack([0.5 + 0.496 * np.cos(angle), 0.496 * np.sin(angle)], axis=1)
    V, faces = revolved(profile, segments)
    last, first = (len(V) - segments + np.arange(segments)).tolist(), list(range(segments))
    faces += [
        (last[i], last[(i + 1) % segments], first[(i + 1) % segments], first[i])
        for i in range(segments)
    ]
    return [add("Torus", (V, faces))]


def mixed_winding(segments=32):
    """Return an ellipsoid of which every third face has the wrong side out."""
    V, faces = ball(radii=(1, 0.8, 1.2), segments=segments, rings=segments // 2)
    faces = [face[::-1] if number % 3 == 0 else face for number, face in enumerate(faces)]
    return [add("Mixed", moved((V, faces), Matrix.Rotation(0.4, 3, (1, 1, 0))))]


def with_fin(segments=32):
    """Return an ellipsoid with a fin on its back: three faces meet at each edge there."""
    V, faces = ball(radii=(0.7, 1.2, 0.7), segments=segments, rings=segments // 2)
    along = [face for face in faces if len(face) == 4]
    seam = [i for i in range(len(V)) if abs(V[i, 0]) < 1e-9 and V[i, 1] > 0.3]
    seam.sort(key=lambda i: V[i, 2])
    assert along and len(seam) > 4
    levels, count = [seam], len(V)
    for level in (1, 2, 3):
        V = np.concatenate([V, V[seam] * [1, 1 + 0.12 * level, 1 + 0.05 * level]])
        levels.append([count + i for i in range(len(seam))])
        count = len(V)
    for low, high in pairwise(levels):
        faces = faces + [(low[i], low[i + 1], high[i + 1], high[i]) for i in range(len(seam) - 1)]
    return [add("Fin", moved((V, faces), Matrix.Rotation(0.3, 3, (1, 0, 0.5))))]


def _rounded(V):
    """Return the hand's grid with each finger's square section turned into a round one."""
    pitch = WIDTH + SLIT
    finger = np.minimum(V[:, 0] // pitch, FINGERS - 1)
    a = np.clip((V[:, 0] - finger * pitch) / WIDTH * 2 - 1, -1, 1)
    b = 2 * V[:, 2]
    z = b * np.sqrt(1 - 0.5 * a**2)
    length = 1.9 - 0.09 * (finger - 1.3) ** 2
    y = V[:, 1] / 1.9
    y = np.where(y > 0.4, 0.4 + (y - 0.4) * (length / 1.9 - 0.4) / 0.6, y)
    tip = np.clip((y * 1.9 - (length - 0.12)) / 0.12, 0, 1)
    shrink = np.sqrt(1 - 0.6 * tip**2)
    x = finger * pitch + WIDTH / 2 * (1 + a * shrink)
    return np.stack([x, y * 1.9, 0.5 * WIDTH * z * shrink], axis=1)


def _filled(points, step=0.05):
    """Return a polyline with points at most a step apart."""
    points = np.asarray(points, float)
    pieces = [points[:1]]
    for a, b in pairwise(points):
        count = max(1, int(np.ceil(np.linalg.norm(b - a) / step)))
        pieces.append(a + np.linspace(0, 1, count + 1)[1:, None] * (b - a))
    return np.concatenate(pieces)
