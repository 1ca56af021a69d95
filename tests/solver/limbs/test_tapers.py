# SPDX-License-Identifier: GPL-3.0-or-later
"""What tapers keeps its direction, too: beaks and horns, of which one side may lie level."""

import numpy as np
import pytest
from proxy_shapes import uv_sphere

from solver import ProxyOptions, stylize

SIDES, RINGS = 16, 24


def horn(degrees, length):
    """Return a horn that leans and whose one side runs along it, its direction, and its head."""
    a = np.radians(degrees)
    d = np.array([0.8 * np.sin(a), 0.6 * np.sin(a), np.cos(a)])
    x = np.cross(d, [0.3, 0.2, 0.9])
    x /= np.linalg.norm(x)
    y = np.cross(d, x)
    t, angle = np.meshgrid(np.linspace(0, 1, RINGS), 2 * np.pi * np.arange(SIDES) / SIDES)
    t, angle = t.T[..., None], angle.T[..., None]
    radius, middle = 0.2 - 0.18 * t, (0.5 + length * t) * d - 0.162 * t * y
    V = (middle + radius * (np.cos(angle) * x + np.sin(angle) * y)).reshape(-1, 3)
    V = np.concatenate([V, [0.5 * d], middle[-1]])
    i = np.arange(SIDES * RINGS).reshape(RINGS, SIDES)
    p, q = i[:-1].ravel(), np.roll(i, -1, axis=1)[:-1].ravel()
    first, second = np.roll(i[0], -1), np.roll(i[-1], -1)
    F = [
        np.stack([p, q, q + SIDES], 1),
        np.stack([p, q + SIDES, p + SIDES], 1),
        np.stack([np.full(SIDES, len(V) - 2), first, i[0]], 1),
        np.stack([np.full(SIDES, len(V) - 1), i[-1], second], 1),
    ]
    head, of_head = uv_sphere(32, 16)
    return np.concatenate([V, 0.7 * head]), np.concatenate([*F, of_head + len(V)])


def direction(V):
    middles = V[: SIDES * RINGS].reshape(RINGS, SIDES, 3).mean(axis=1)[RINGS // 4 :]
    return np.linalg.svd(middles - middles.mean(axis=0))[2][0]


@pytest.mark.parametrize(("degrees", "length"), [(20, 0.8), (35, 0.8), (45, 0.6)])
def test_a_horn_keeps_its_direction(degrees, length):
    V, F = horn(degrees, length)
    result = stylize(V, F, proxy=ProxyOptions(), keep_rotation=True)
    cosine = abs(direction(V) @ direction(result.positions))
    assert np.degrees(np.arccos(min(cosine, 1.0))) < 5.0
