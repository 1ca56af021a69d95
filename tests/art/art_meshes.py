# SPDX-License-Identifier: GPL-3.0-or-later
"""What everybody begins with: the monkey, and sets of parts that touch without a common vertex."""

import bpy
import numpy as np
from art_objects import add, apply_modifiers
from art_parts import revolved, tube


def monkey(levels=2):
    """Return Suzanne with so many levels of Subdivision applied; her eyes are parts of their own.

    507 vertices at level 0, 2012 at 1, 7958 at 2.
    """
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.object
    if levels:
        obj.modifiers.new("Subdivision", "SUBSURF").levels = levels
        apply_modifiers(obj)
    obj.data.shade_smooth()
    return [obj]


def teapot(segments=48):
    """Return body, lid, spout and handle as four open parts of one mesh, as the famous one has."""
    body = [(0, 0), (0.5, 0.01), (0.85, 0.06), (1.15, 0.2), (1.3, 0.42), (1.3, 0.65), (1.2, 0.95)]
    body += [(1.05, 1.2), (0.9, 1.36), (0.84, 1.42), (0.82, 1.44)]
    lid = [(0.84, 1.43), (0.7, 1.5), (0.4, 1.57), (0.16, 1.64), (0.09, 1.7), (0.12, 1.77)]
    lid += [(0.2, 1.84), (0.17, 1.92), (0.08, 1.96), (0, 1.97)]
    spout = [(1.18, 0, 0.55), (1.5, 0, 0.62), (1.72, 0, 0.85), (1.85, 0, 1.1), (2.02, 0, 1.3)]
    spout += [(2.2, 0, 1.38)]
    handle = [(-1.12, 0, 1.16), (-1.45, 0, 1.2), (-1.72, 0, 1.12), (-1.82, 0, 0.9)]
    handle += [(-1.75, 0, 0.66), (-1.5, 0, 0.46), (-1.24, 0, 0.36)]
    fine = max(segments // 2, 8)
    spout = _smooth(spout, fine)
    return [
        add(
            "Teapot",
            revolved(_smooth(body, segments), segments),
            revolved(_smooth(lid, fine), segments),
            tube(spout, np.linspace(0.34, 0.13, len(spout)), fine, is_capped=False),
            tube(_smooth(handle, fine), np.full(fine, 0.1), 12, is_capped=False),
        )
    ]


def _smooth(points, count):
    """Return a curve (count,k) through points, evenly cut; what lies on the axis stays there."""
    from scipy.interpolate import PchipInterpolator

    points = np.asarray(points, float)
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    curve = PchipInterpolator(length, points)(np.linspace(0, length[-1], count))
    curve[[0, -1]] = points[[0, -1]]
    return curve
