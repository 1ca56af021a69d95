# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces without an inside: open sheets, and what lies near both of their sides."""

import numpy as np
from art_objects import add
from art_parts import ball, blocks, moved, revolved, sheet
from mathutils import Matrix


def wavy_plane(count=60):
    """Return a square sheet with waves."""
    return [add("Waves", sheet(_waves, count, count))]


def bowl(segments=48):
    """Return half a sphere, open at the top."""
    angle = np.linspace(0, np.pi / 2, 16)
    profile = np.stack([np.sin(angle), -np.cos(angle)], axis=1)
    return [add("Bowl", revolved(profile, segments))]


def pipe(segments=40):
    """Return a bulging tube without caps."""
    z = np.linspace(-1, 1, 30)
    return [add("Pipe", revolved(np.stack([0.5 + 0.1 * np.cos(3 * z), z], axis=1), segments))]


def cape_at_wall(gap=0.004):
    """Return a wall, a closed slab, and an open cape along it; two objects.

    `gap`: between them, as a share of the size.
    """
    x, z = np.linspace(-1, 1, 41), np.linspace(0, 2, 41)
    wall = blocks(x, np.array([0, 0.05, 0.1]), z, np.ones((40, 2, 40), bool))
    cape = sheet(lambda x, y: (1.6 * x - 0.8, 0 * x, 0.2 + 1.6 * y), 36, 36)
    return [add("Wall", _bent(wall)), add("Cape", _bent(moved(cape, offset=(0, -2 * gap, 0))))]


def cubes_at_sheet(gap=0.005):
    """Return a wavy sheet and a rounded block at each of its sides; three objects."""
    height = gap + 0.35
    plane = sheet(lambda x, y: (2 * x - 1, 2 * y - 1, 0 * x), 50, 50)
    steps = np.linspace(-0.35, 0.35, 13)
    cube = blocks(steps, steps, steps, np.ones((12, 12, 12), bool))
    turn = Matrix.Rotation(np.radians(25), 3, "Z")
    above = moved(cube, turn, (0.2, 0, height))
    below = moved(cube, turn, (-0.2, 0, -height))
    return [
        add(name, _tilted(part))
        for name, part in (("Sheet", plane), ("Above", above), ("Below", below))
    ]


def two_sheets(gap=0.005):
    """Return a ball between two wavy sheets of one mesh, none of which touch."""
    lower = sheet(_waves, 40, 40)
    upper = moved(lower, offset=(0, 0, gap))
    return [add("Sheets", lower, upper, ball((0, 0, 0.75), (0.4, 0.4, 0.4)))]


def _waves(x, y):
    return 2 * x - 1, 2 * y - 1, 0.15 * np.sin(6 * x) * np.cos(5 * y)


def _bent(part):
    """Return the part bent about the Z axis, as far as 30 degrees at its sides."""
    V, faces = part
    x, y, z = V.T
    angle = 0.5 * x
    return np.stack([(2 - y) * np.sin(angle), 2 - (2 - y) * np.cos(angle), z], axis=1), faces


def _tilted(part):
    return moved(part, Matrix.Rotation(np.radians(20), 3, (1, 0.6, 0)))
