# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry in the panel: the axes, and how much of the mesh is symmetric."""

from functools import lru_cache

import numpy as np

from ...solver import CubicCraftError
from ...solver.pieces.shape import LEAST_MATCHING as SYMMETRIC
from ...solver.pieces.whole import Whole
from ...solver.surface.symmetry import LEAST_MATCHING
from .. import mesh_bridge
from ..read.reflections import modifier_reflections

_MOST_VERTICES = 200_000
"""larger meshes are not counted, because that would slow down the panel"""
_AXES = "XYZ"


def draw_symmetry(layout, obj, properties):
    """Draw the axes, and below them what is symmetric."""
    row = layout.row(align=True, heading="Symmetry")
    row.prop(properties, "keep_symmetric", text="Auto", toggle=True)
    for axis, name in enumerate(_AXES):
        row.prop(properties, "symmetry", index=axis, text=name, toggle=True)
    text, icon = _says(obj, tuple(properties.symmetry))
    if text:
        layout.label(text=text, icon=icon)


def _says(obj, symmetry):
    is_mirrored = bool(modifier_reflections(obj))
    if not any(symmetry):
        return "Follows the Mirror modifier" if is_mirrored else "", "MOD_MIRROR"
    mesh = mesh_bridge.mesh_of(obj)
    if mesh.is_editmode or len(mesh.vertices) > _MOST_VERTICES:
        return "", "NONE"
    try:
        positions = mesh_bridge.original_positions(mesh)
    except CubicCraftError:
        return "", "NONE"
    matching = _matching(positions.tobytes(), symmetry)
    text = f"{matching:,} of {len(positions):,} match"
    if matching < LEAST_MATCHING * len(positions):
        return f"Only {text}", "ERROR"
    if matching < SYMMETRIC * len(positions):
        text += "; the rest is free"
    return text, "MOD_MIRROR"


@lru_cache(maxsize=4)
def _matching(positions, symmetry):
    """Count the vertices with a partner, of positions as bytes."""
    V = np.frombuffer(positions, np.float32).reshape(-1, 3)
    return Whole(V, np.empty((0, 3), dtype=np.intp), (), symmetry).matching or 0
