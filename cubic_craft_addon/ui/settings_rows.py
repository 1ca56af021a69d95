# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings that the panel and Adjust Last Operation show alike, line by line.

`properties` is what has them: an object, Live or the operator.
"""

from typing import Any

import bpy

from ...solver.method import Advanced, Computation, Kept
from ...solver.setting import declared


def draw_orientation(layout: Any, properties: Any, *, is_by_name: bool) -> None:
    """Draw how the form is turned, and the object that it is relative to; Live has its name."""
    layout.prop(properties, "space")
    if properties.space == "FRAME" and is_by_name:
        layout.prop_search(properties, "frame", bpy.data, "objects")
    elif properties.space == "FRAME":
        layout.prop(properties, "frame")
    layout.prop(properties, "orientation")


def draw_volume(layout: Any, properties: Any) -> None:
    """Draw what is kept of pose, details, thickness and parts."""
    for name in declared(Kept):
        if name == "detail":
            _draw_detail(layout, properties)
        elif name != "detail_strength":
            layout.prop(properties, name, slider=True)


def _draw_detail(layout, properties):
    """Draw the size and the strength of details in one row: split as Blender splits properties."""
    split = layout.split(factor=0.4, align=True)
    label = split.row()
    label.alignment = "RIGHT" if layout.use_property_split else "LEFT"
    label.label(text="Detail")
    row = split.row(align=True)
    row.use_property_split = False
    row.prop(properties, "detail", text="", slider=True)
    row.prop(properties, "detail_strength", text="", slider=True)


def draw_advanced(layout: Any, properties: Any) -> None:
    """Draw what is rarely changed."""
    for name in declared(Advanced):
        layout.prop(properties, name)


def draw_solver(layout: Any, properties: Any) -> None:
    """Draw where it is computed, and when that ends."""
    for name in declared(Computation):
        layout.prop(properties, name)
